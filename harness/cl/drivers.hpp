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
/// for some milliseconds. Launches of 0.2 to 10 ms then took up to twice their time (docs/performance.md).
/// The function does nothing if may_pin() is false for the cores that the process may use.
void pin_threads();

/// Returns the folder in which PoCL keeps compiled kernels: $POCL_CACHE_DIR; if this variable is not set,
/// $XDG_CACHE_HOME/pocl/kcache; otherwise $HOME/.cache/pocl/kcache. The path is empty if none of these three
/// variables is set.
std::filesystem::path kernel_cache();

/// If files cannot be written in kernel_cache(), sets POCL_CACHE_DIR to a new temporary folder and prints a
/// message to stderr. Without a writable folder, PoCL reports no device. The temporary folder is deleted when
/// the program ends.
void need_kernel_cache();

/// Calls pin_threads() and need_kernel_cache(), and registers NVIDIA's driver. Containers receive this driver
/// without the file in /etc/OpenCL/vendors that names its library. If one of the driver's folders contains
/// the library, this function adds the library to the loader's existing entries. The function must run before
/// the first OpenCL call; later calls have no effect. It searches the folders in $PELAGE_DRIVERS, which are
/// separated by colons. If this variable is not set, it searches the folders in $LD_LIBRARY_PATH and the
/// folders that distributions and containers use for the driver. If OCL_ICD_VENDORS is set, the function does
/// not change the loader's entries.
void announce_drivers();

}  // namespace pelage::cl
