// Runs work in a child process, so that a crash, an endless loop or excessive memory use becomes an error
// message.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace pelage {

struct Limits {
  std::uint64_t memory;       ///< address space in addition to the parent's, bytes
  std::chrono::seconds time;  ///< wall clock time
  std::chrono::milliseconds silence = std::chrono::seconds(20);  ///< interval of "still at work" messages
};

using Say = std::function<void(const std::string&)>;

/// Runs `work` in a child process and returns its bytes. `progress` receives the messages of `work`. If
/// `work` sends no message for limits.silence, `progress` receives a message with the elapsed seconds.
/// Rethrows an InputError of the child. A crash, an exceeded limit or any other exception becomes an
/// InputError that begins with `name`.
std::string isolated(const std::string& name, const Limits& limits,
                     const std::function<std::string(const Say&)>& work, const Say& progress);

}  // namespace pelage
