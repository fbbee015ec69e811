// How much memory the process has needed, by its own high-water mark.
#pragma once
#include <cstdint>

namespace pelage {

/// The most resident memory since the start or the last reset, bytes (Linux's VmHWM); 0 where it cannot be
/// read.
std::uint64_t peak_memory();

/// From here on: the mark falls to what is resident now. Where the kernel does not allow it the mark stays,
/// and peak_memory() is an upper bound.
void reset_peak_memory();

}  // namespace pelage
