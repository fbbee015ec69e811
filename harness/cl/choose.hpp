// Selects a device by the text that the user gave.
#pragma once
#include <vector>

#include "harness/cl/device.hpp"

namespace pelage::cl {

/// Searches the list `all` for the device that `wanted` names, by the rules in the comment on choose_device()
/// (device.hpp). Returns the index of this device. If `wanted` is empty, returns the index of the first GPU.
/// If there is no GPU, returns the index of the first CPU. If there is no CPU either, returns the index of
/// the first device. Throws InputError if `wanted` names no device or several devices. The message begins
/// with `origin`, which says where the user gave the text (--device or PELAGE_DEVICE).
std::size_t choose(const std::vector<DeviceInfo>& all, std::string_view wanted, std::string_view origin);

}  // namespace pelage::cl
