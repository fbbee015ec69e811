// Drivers that the OpenCL loader was not told of.
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

/// Containers get NVIDIA's driver without the file in /etc/OpenCL/vendors that names its library: where the
/// driver's folders hold it, the loader is told of it beside the entries that there are. Before the first
/// call of OpenCL; later ones find all as it is. Folders: $PELAGE_DRIVERS (several with : between),
/// $LD_LIBRARY_PATH, and where distributions and containers put the driver. Left alone: what OCL_ICD_VENDORS
/// says.
void announce_drivers();

}  // namespace pelage::cl
