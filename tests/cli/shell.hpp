// Runs the pelage binary of this build in a shell, in a temporary folder, and checks how it ended.
#pragma once
#include <fmt/format.h>
#include <sys/wait.h>

#include <sstream>
#include <stdexcept>

#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage::cli {

using test::expect_has;
using test::expect_lacks;
using test::Folder;
using test::has;

struct Outcome {
  int code = -1;
  std::string out, err;
  std::string arguments;  ///< of the command, for the messages of failed tests
};

/// Runs a shell command in the folder, whose files `stdout` and `stderr` get its output. Returns its exit
/// code, which is 128 + n if the signal n ended it.
inline int shell(const Folder& folder, const std::string& command) {
  // The option detect_leaks=0 switches off the leak check, because the OpenCL libraries leak memory.
  // AddressSanitizer still reports other memory errors.
  const int status =
      std::system(fmt::format("cd '{}' && export ASAN_OPTIONS=detect_leaks=0 && {{\n{}\n}} >stdout 2>stderr",
                              folder.path.string(), command)
                      .c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Runs pelage inside the folder for at most 300 s. `arguments` is a text that the shell splits into
/// arguments. `environment` contains assignments such as "A=1 B=2".
inline Outcome pelage(const Folder& folder, const std::string& arguments, const std::string& environment = "",
                      const std::string& binary = PELAGE_BINARY) {
  const int code = shell(folder, environment + " timeout 300 '" + binary + "' " + arguments);
  return {code, folder.read("stdout"), folder.read("stderr"), arguments.substr(0, 200)};
}

/// Runs pelage, which must succeed. Otherwise the test ends, because this function throws the messages.
inline Outcome done(const Folder& folder, const std::string& arguments, const std::string& environment = "") {
  Outcome outcome = pelage(folder, arguments, environment);
  if (outcome.code != 0)
    throw std::runtime_error(
        fmt::format("{}: code {}\n{}{}", outcome.arguments, outcome.code, outcome.out, outcome.err));
  return outcome;
}

/// A test that runs pelage in a temporary folder of its own.
struct InFolder : test::InFolder {
  int shell(const std::string& command) const { return cli::shell(folder, command); }
  Outcome pelage(const std::string& arguments, const std::string& environment = "",
                 const std::string& binary = PELAGE_BINARY) const {
    return cli::pelage(folder, arguments, environment, binary);
  }
  Outcome done(const std::string& arguments, const std::string& environment = "") const {
    return cli::done(folder, arguments, environment);
  }
};

/// Expects that pelage refused its input: it ended with `code`, and its only message, the last line on
/// stderr, contains `text`. If `steps` is true, warnings and lines about the preparation of a mesh may
/// precede the message.
inline void expect_refused(const Outcome& outcome, const std::string& text, bool steps = false,
                           int code = 2) {
  SCOPED_TRACE(outcome.arguments + "\n" + outcome.err);
  EXPECT_EQ(outcome.code, code);
  std::string last;
  int lines = 0, messages = 0;
  std::istringstream stream(outcome.err);
  for (std::string line; std::getline(stream, line); ++lines) {
    messages += line.starts_with("pelage: ") && !line.starts_with("pelage: warning: ");
    last = line;
  }
  EXPECT_EQ(steps ? messages : lines, 1);
  EXPECT_TRUE(last.starts_with("pelage: ") && has(last, text)) << "the message has no " << text;
}

/// Returns an experiment with the lines `axes` in the table [axes] and the lines `scene` in the table
/// [scene]. Each case has six timed frames.
inline std::string experiment(const std::string& axes, const std::string& scene = "") {
  return "name = \"own\"\n[axes]\n" + axes + "\n[scene]\nfur.texture = 64\n" + scene +
         "\n[preset.quick]\nwarm_up_s = 0.0\nleast = 6\nmost = 6\nprecision = 1.0\nlimit_s = 60.0\n";
}

/// Returns an experiment that draws a torus at 320 x 240 pixels.
inline std::string of_torus(const std::string& axes, const std::string& scene = "") {
  return experiment("model = [\"torus-24x12\"]\n" + axes + "\nsize = [\"320x240\"]", scene);
}

inline std::string journal_in(const Folder& folder, const std::string& results) {
  return test::files_below(folder.path / results, ".jsonl").at(0).lexically_relative(folder.path).string();
}

}  // namespace pelage::cli
