// Settings for drivers before they start, and registration of drivers that the OpenCL loader does not know.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

namespace pelage::cl {

/// Returns NVIDIA's OpenCL library in the first of `folders` that contains one: libnvidia-opencl.so.1, else
/// the versioned file.
std::optional<std::filesystem::path> nvidia_library(const std::vector<std::filesystem::path>& folders);

/// Returns true if an entry (.icd) of `vendors` already names that library.
bool names_nvidia(const std::filesystem::path& vendors);

/// Returns true if a process that runs on `cores` may pin thread i to core i, that is, if `cores` are all
/// cores of the machine, 0 .. online - 1.
bool may_pin(const std::vector<int>& cores, int online);

/// Sets POCL_AFFINITY=1 unless the variable is set, so PoCL pins each of its threads to a separate core.
/// Otherwise, if one core has just become idle, Linux wakes two threads on the other core and leaves them
/// there for some milliseconds: launches of 0.2 to 10 ms took up to twice their time (docs/performance.md).
/// Does nothing if the process may use only some cores, because PoCL counts from core 0.
void pin_threads();

/// Calls pin_threads() and registers NVIDIA's driver. Containers receive this driver without the file in
/// /etc/OpenCL/vendors that names its library. If one of the driver's folders contains the library, this
/// function adds it to the loader's existing entries. Must run before the first OpenCL call; later calls have
/// no effect. Folders: $PELAGE_DRIVERS (separated by colons), $LD_LIBRARY_PATH, and the folders that
/// distributions and containers use for the driver. Does nothing to the loader if OCL_ICD_VENDORS is set.
void announce_drivers();

}  // namespace pelage::cl
