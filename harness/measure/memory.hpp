// Measures the peak memory of this process.
#pragma once
#include <cstdint>

namespace pelage {

/// Returns the largest resident memory in bytes since the start or the last reset (VmHWM of Linux). Returns 0
/// if it cannot be read.
std::uint64_t peak_memory();

/// Sets the peak to the memory that is resident now. If the kernel does not allow this, the peak is
/// unchanged, and peak_memory() is an upper bound.
void reset_peak_memory();

}  // namespace pelage
