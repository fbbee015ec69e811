// Changes driver settings before the drivers are loaded, and registers drivers that the OpenCL loader does
// not know.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

namespace pelage::cl {

/// Returns the path of NVIDIA's OpenCL library in the first of `folders` that contains it. The library is
/// libnvidia-opencl.so.1, or else the file with a version number in its name.
std::optional<std::filesystem::path> nvidia_library(const std::vector<std::filesystem::path>& folders);

/// Returns true if a file *.icd in the folder `vendors` already names NVIDIA's library.
bool names_nvidia(const std::filesystem::path& vendors);

/// Returns true if a process that may run on `cores` may pin thread i to core i. This holds if `cores`
/// contains all cores of the machine, 0 .. online - 1.
bool may_pin(const std::vector<int>& cores, int online);

/// Sets POCL_AFFINITY=1 unless the variable is set. PoCL then pins thread i to core i. Without pinning, Linux
/// sometimes wakes two threads on one core although another core has just become idle, and leaves them there
/// for some milliseconds. Launches that take 0.2 to 10 ms with pinning then took up to twice as long
/// (docs/performance.md). The function does nothing if may_pin() is false for the cores that the process may
/// use.
void pin_threads();

/// Calls pin_threads(), need_kernel_cache() and explain_aborts(), and registers NVIDIA's driver. Containers
/// receive this driver without the file in /etc/OpenCL/vendors that names its library. If one of the driver's
/// folders contains the library, this function adds the library to the loader's existing entries. The
/// function must run before the first OpenCL call; later calls have no effect. It searches the folders in
/// $PELAGE_DRIVERS, which are separated by colons. If this variable is not set, it searches the folders in
/// $LD_LIBRARY_PATH and the folders that distributions and containers use for the driver. If OCL_ICD_VENDORS
/// is set, the function does not change the loader's entries.
void announce_drivers();

}  // namespace pelage::cl
