// Work done in a child process, so that a crash, a hang or a hunger for memory ends as one clear error.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace pelage {

struct Limits {
  std::uint64_t memory;       ///< bytes of address space, beyond what the process already has
  std::chrono::seconds time;  ///< wall clock
  std::chrono::milliseconds silence = std::chrono::seconds(20);  ///< after so long without a word, see below
};

using Say = std::function<void(const std::string&)>;

/// Runs `work` in a child process and gives its bytes back; what it says on the way is said by `progress`
/// here. An InputError of the child is thrown here; a crash, an exhausted limit or any other exception
/// becomes an InputError that begins with `name`. Where the work says nothing for `silence`, `progress` is
/// told that it goes on, and for how many seconds it has.
std::string isolated(const std::string& name, const Limits& limits,
                     const std::function<std::string(const Say&)>& work, const Say& progress);

}  // namespace pelage
