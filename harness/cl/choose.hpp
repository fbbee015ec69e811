// Selects a device by the user's text.
#pragma once
#include <vector>

#include "harness/cl/device.hpp"

namespace pelage::cl {

/// Returns the index in `all` of the device that `wanted` names, by the rules of choose_device. If `wanted`
/// is empty, it returns the first GPU, else the first CPU, else the first device. Throws InputError if
/// `wanted` names no device or several devices; the message begins with `origin` (--device, PELAGE_DEVICE).
std::size_t choose(const std::vector<DeviceInfo>& all, std::string_view wanted, std::string_view origin);

}  // namespace pelage::cl
