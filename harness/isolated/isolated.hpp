// Runs a function in a child process. A crash, an endless loop or excessive memory use of this function then
// becomes an InputError in the calling process.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

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

}  // namespace pelage
