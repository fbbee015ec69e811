// Changes driver settings before the drivers are loaded, and registers drivers that the OpenCL loader does
// not know.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

namespace pelage::cl {

/// Returns the path of NVIDIA's OpenCL library in the first of `folders` that contains it. The library is the
/// file libnvidia-opencl.so.1. If the folder does not contain this file, the library is a file
/// libnvidia-opencl.so.VERSION.
std::optional<std::filesystem::path> nvidia_library(const std::vector<std::filesystem::path>& folders);

/// Returns true if a file *.icd in the folder `vendors` already names NVIDIA's library.
bool names_nvidia(const std::filesystem::path& vendors);

/// Returns true if PoCL may pin its thread i to core i for every i. `cores` are the cores that the process
/// may use. The result is true if `cores` contains all cores of the machine, 0 .. online - 1.
bool may_pin(const std::vector<int>& cores, int online);

/// Sets POCL_AFFINITY=1 unless the variable is set. PoCL then pins its thread i to core i. Without pinning,
/// Linux sometimes wakes two threads on the same core although another core has become idle. Both threads
/// then stay on this core for some milliseconds. Launches took 0.2 to 10 ms with pinning, and up to twice as
/// long without pinning (docs/machines.md). The function does nothing if may_pin() is false for the cores
/// that the process may use.
void pin_threads();

/// Calls pin_threads(), need_kernel_cache() and explain_aborts(), and registers NVIDIA's driver. A container
/// receives NVIDIA's driver without the file in /etc/OpenCL/vendors that names the driver's library. If this
/// file is missing, the function searches for the library and adds it to the loader's existing entries. The
/// function must run before the first OpenCL call; later calls have no effect. It searches the folders in
/// $PELAGE_DRIVERS, which are separated by colons. If this variable is not set, it searches the folders in
/// $LD_LIBRARY_PATH and the folders that distributions and containers use for the driver. If OCL_ICD_VENDORS
/// is set, the function does not change the loader's entries.
void announce_drivers();

}  // namespace pelage::cl
