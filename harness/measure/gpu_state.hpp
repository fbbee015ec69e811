// Clocks and temperature of a GPU, which change its speed.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "harness/cl/device.hpp"

namespace pelage {

/// Returns `core_mhz`, `memory_mhz` and `celsius` of a GPU, as far as they are known, and for NVIDIA
/// `slowed`, the reasons for which the driver lowers the clocks (bits; 0: none). Asks nvidia-smi, or reads
/// the files of the Linux drivers amdgpu and i915. Empty for other devices, and if neither is there.
nlohmann::ordered_json gpu_state(const cl::DeviceInfo& device);

/// The same from the text that nvidia-smi printed for `nvidia_query`: a line per GPU. Takes the first GPU
/// whose name is `name`.
nlohmann::ordered_json gpu_state_of_nvidia(const std::string& text, const std::string& name);
inline constexpr const char* nvidia_query =
    "--query-gpu=name,clocks.sm,clocks.mem,temperature.gpu,clocks_throttle_reasons.active";

/// The same from the folder of a graphics card, such as /sys/class/drm/card0.
nlohmann::ordered_json gpu_state_of_card(const std::filesystem::path& card);

}  // namespace pelage
