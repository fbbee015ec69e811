// Runs tests of this binary with other OpenCL compilers than the default one, each in a child process whose
// environment selects the compiler.
#pragma once
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "harness/cl/device.hpp"
#include "tests/support/files.hpp"

namespace pelage::portability {

/// An OpenCL compiler. `platform` is the name of its OpenCL platform. The environment variables in
/// `environment` make a child process use this compiler.
struct Place {
  std::string name, platform, environment;
  std::vector<std::string> mappings;  ///< mappings that this compiler supports
  bool slow;                          ///< true: compiling takes minutes
};

inline void PrintTo(const Place& place, std::ostream* out) {
  *out << place.name;
}

/// Returns the compilers. PoCL has several methods of combining work-items into a work-group. All other tests
/// use its default method, which generates loops over the work-items and vectorizes them with LLVM. This list
/// adds two methods of PoCL. "loops" generates loops without vectorization. "repl" copies the code of the
/// kernel for each work-item, so it needs small work-groups (docs/machines.md). The list also contains the
/// platform rusticl.
inline const std::vector<Place>& places() {
  static const std::string pocl = "Portable Computing Language";
  static const std::vector<Place> all{
      {"loops", pocl, "POCL_WORK_GROUP_METHOD=loops", {"tile", "pixel", "group"}, false},
      {"repl", pocl, "POCL_WORK_GROUP_METHOD=repl POCL_MAX_WORK_GROUP_SIZE=16", {"tile", "pixel"}, false},
      {"rusticl", "rusticl", "RUSTICL_ENABLE=llvmpipe PELAGE_LANES=1", {"pixel", "group"}, true},
  };
  return all;
}

/// Returns the reason why this compiler cannot be tested now, or an empty string.
inline std::string obstacle(const Place& place, bool slow) {
  const auto platforms = cl::platforms();
  if (std::none_of(platforms.begin(), platforms.end(),
                   [&](const cl::PlatformInfo& platform) { return platform.name == place.platform; }))
    return fmt::format("no OpenCL platform '{}' here", place.platform);
  if (slow && std::getenv("PELAGE_SLOW_TESTS") == nullptr)
    return fmt::format("compiling takes {} minutes: PELAGE_SLOW_TESTS=1 runs it, as .ci/full does",
                       place.name);
  return {};
}

/// A temporary folder for the files of a child process.
struct Elsewhere : test::Folder {
  /// Runs the disabled test `test` with the compiler `place` for at most `seconds`. Returns an empty string
  /// if the test passed, else its exit status and the end of its output.
  std::string run(const Place& place, const std::string& test, int seconds,
                  const std::string& variables = "") const {
    const std::string said = (path / "said").string();
    const std::string command = fmt::format(
        "ASAN_OPTIONS=detect_leaks=0 {} {} PELAGE_DEVICE='{}' PELAGE_TEST_FOLDER='{}' timeout {} '{}' --gtest_filter='{}' --gtest_also_run_disabled_tests >'{}' 2>&1",
        place.environment, variables, place.platform, path.string(), seconds,
        std::filesystem::read_symlink("/proc/self/exe").string(), test, said);
    const int status = std::system(command.c_str());
    std::string text = test::text_of(said);
    // PoCL prints this message if it does not know the method in POCL_WORK_GROUP_METHOD. PoCL then uses its
    // default method, so the child process did not test the method of `place`.
    if (text.find("Unknown work group generation method") != std::string::npos)
      return "PoCL knows no such method";
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    if (text.size() > 1500) text.erase(0, text.size() - 1500);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return fmt::format(
        "{} at {}: {}\n{}", test, place.name,
        code == 124 ? fmt::format("not done after {} s", seconds) : fmt::format("exit {}", code), text);
  }

  template <class T>
  std::vector<T> values_of(const std::string& name) const {
    const std::string bytes = read(name);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::copy_n(bytes.data(), values.size() * sizeof(T), reinterpret_cast<char*>(values.data()));
    return values;
  }
};

/// Writes values to a file that Elsewhere::values_of() reads. The child process calls this function.
template <class T>
void leave(const std::string& name, const std::vector<T>& values) {
  const char* folder = std::getenv("PELAGE_TEST_FOLDER");
  std::ofstream stream(std::filesystem::path(folder != nullptr ? folder : ".") / name, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(values.data()), std::streamsize(values.size() * sizeof(T)));
}

}  // namespace pelage::portability
