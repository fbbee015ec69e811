// Which device a user means.
#pragma once
#include <vector>

#include "harness/cl/device.hpp"

namespace pelage::cl {

/// The position in `all` of the device that `wanted` names, by the rules of choose_device; `origin`
/// (--device, PELAGE_DEVICE) stands in the message when it names none or several. Empty: the first GPU, else
/// the first CPU, else the first of all.
std::size_t choose(const std::vector<DeviceInfo>& all, std::string_view wanted, std::string_view origin);

}  // namespace pelage::cl
