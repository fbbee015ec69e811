// Runs a function in a child process. A crash, an endless loop or excessive memory use of this function then
// becomes an InputError in the calling process. Also runs other programs, without a shell.
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pelage {

struct Limits {
  /// Number of bytes by which the child process may enlarge its address space. When the child
  /// process starts, its address space is as large as that of the parent process.
  std::uint64_t memory;
  std::chrono::seconds time;  ///< limit of the child's run time (wall-clock time)
  /// If the child process sends no message for this time, isolated() reports "still at work".
  std::chrono::milliseconds silence = std::chrono::seconds(20);
  /// Noun in error messages for the data that `work` reads, as in "the mesh library crashed on it" and "give
  /// a simpler mesh".
  const char* what = "mesh";
};

using Say = std::function<void(const std::string&)>;

/// Runs `work` in a child process and returns the bytes that `work` returns. `progress` receives the messages
/// of `work`. If `work` sends no message for the duration limits.silence, isolated() passes a message with
/// the elapsed time in seconds to `progress`. Rethrows an InputError that `work` throws. A crash, an exceeded
/// limit or any other exception becomes an InputError that begins with `name`.
std::string isolated(const std::string& name, const Limits& limits,
                     const std::function<std::string(const Say&)>& work, const Say& progress);

struct ProgramOutcome {
  int code = -1;         ///< exit code; 127: the program cannot be started; -1: it ended by a signal
  std::string messages;  ///< what it wrote to stdout and stderr
};

/// Runs the program words[0], which is a path or a name that is searched on PATH, with the arguments that
/// follow. The program reads nothing from stdin. It runs in `folder`, or in the present folder if `folder` is
/// empty.
ProgramOutcome run_program(std::vector<std::string> words, const std::filesystem::path& folder = {});

/// True if a folder of PATH contains the program `name`.
bool on_path(const std::string& name);

/// Returns the last line of a text, without empty lines at its end.
std::string last_line(std::string text);

}  // namespace pelage
