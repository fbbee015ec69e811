// Runs the pelage binary of this build in a shell, in a temporary folder.
#pragma once
#include <sys/wait.h>

#include "tests/support/files.hpp"

namespace pelage::cli {

struct Outcome {
  int code = -1;
  std::string out, err;
};

/// A new temporary folder. The destructor deletes it.
class Folder {
 public:
  const std::filesystem::path& path() const { return folder_.path; }
  void write(const std::string& name, const std::string& text) const {
    test::write_text(path() / name, text);
  }
  std::string read(const std::string& name) const { return test::text_of(path() / name); }

 private:
  test::Folder folder_;
};

/// Runs pelage inside the folder for at most 300 s. `arguments` is a text that the shell splits into
/// arguments. `environment` contains assignments such as "A=1 B=2".
inline Outcome pelage(const Folder& folder, const std::string& arguments, const std::string& environment = "",
                      const std::string& binary = PELAGE_BINARY) {
  // The option detect_leaks=0 switches off the leak check, because the OpenCL libraries leak memory.
  // AddressSanitizer still reports other memory errors.
  const std::string command = "cd '" + folder.path().string() + "' && ASAN_OPTIONS=detect_leaks=0 " +
                              environment + " timeout 300 '" + binary + "' >stdout 2>stderr " + arguments;
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), folder.read("stdout"),
          folder.read("stderr")};
}

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace pelage::cli
