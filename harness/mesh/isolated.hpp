// Runs work in a child process, so that a crash, an endless loop or excessive memory use becomes an error
// message.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace pelage {

struct Limits {
  std::uint64_t memory;  ///< limit of the address space in bytes, in addition to that of the parent process
  std::chrono::seconds time;  ///< limit of the wall-clock time
  /// Time without a message from the child process after which isolated() sends the message "still at work".
  std::chrono::milliseconds silence = std::chrono::seconds(20);
};

using Say = std::function<void(const std::string&)>;

/// Runs `work` in a child process and returns the bytes that `work` returns. `progress` receives the messages
/// of `work`. If `work` sends no message for limits.silence, `progress` receives a message with the elapsed
/// time in seconds. Rethrows an InputError that `work` throws. A crash, an exceeded limit or any other
/// exception becomes an InputError that begins with `name`.
std::string isolated(const std::string& name, const Limits& limits,
                     const std::function<std::string(const Say&)>& work, const Say& progress);

}  // namespace pelage
