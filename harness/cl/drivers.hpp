// What drivers are told before they start, and drivers that the OpenCL loader was not told of.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

namespace pelage::cl {

/// NVIDIA's OpenCL library in the first of `folders` that holds one: libnvidia-opencl.so.1, else the
/// versioned file.
std::optional<std::filesystem::path> nvidia_library(const std::vector<std::filesystem::path>& folders);

/// Whether an entry (.icd) of `vendors` names that library already.
bool names_nvidia(const std::filesystem::path& vendors);

/// Whether a process that runs on `cores` may keep thread i on core i: they are 0 .. n - 1 of `online` cores.
bool may_pin(const std::vector<int>& cores, int online);

/// Sets POCL_AFFINITY=1 unless it is set: PoCL keeps each of its threads on a core of its own. Linux
/// otherwise wakes two threads on one core where the other has just gone idle, and for some milliseconds
/// leaves them there: launches of 0.2 to 10 ms took up to twice their time (docs/performance.md). Not where
/// the process is confined to some cores: PoCL counts from core 0.
void pin_threads();

/// pin_threads(), and: containers get NVIDIA's driver without the file in /etc/OpenCL/vendors that names its
/// library: where the driver's folders hold it, the loader is told of it beside the entries that there are.
/// Before the first call of OpenCL; later calls find all as it is. Folders: $PELAGE_DRIVERS (several with :
/// between), $LD_LIBRARY_PATH, and where distributions and containers put the driver. Left alone: what
/// OCL_ICD_VENDORS says.
void announce_drivers();

}  // namespace pelage::cl
