// Measures the peak memory of this process.
#pragma once
#include <cstdint>

namespace pelage {

/// Returns the largest resident memory of this process in bytes (VmHWM of Linux) since its start or the last
/// reset. Returns 0 if it cannot be read.
std::uint64_t peak_memory();

/// Sets the peak resident memory of this process to its current resident memory. If Linux does not allow the
/// reset, the peak is unchanged. peak_memory() then returns an upper bound of the peak since this call.
void reset_peak_memory();

}  // namespace pelage
