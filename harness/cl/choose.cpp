#include <fmt/format.h>

#include <boost/algorithm/string/predicate.hpp>
#include <cstdlib>
#include <functional>
#include <optional>

#include "harness/cl/device.hpp"
#include "harness/error.hpp"

namespace pelage::cl {
namespace {

using Test = std::function<bool(const DeviceInfo&)>;

using boost::algorithm::icontains;
using boost::algorithm::iequals;

bool is_platform(const DeviceInfo& info, std::string_view wanted) {
  return icontains(info.platform, wanted) || iequals(info.platform_suffix, wanted);
}

std::vector<std::size_t> matching(const std::vector<DeviceInfo>& all, const Test& wanted) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (wanted(all[i])) found.push_back(i);
  return found;
}

std::string described(const std::vector<DeviceInfo>& all, const std::vector<std::size_t>& which) {
  std::string text;
  for (const std::size_t i : which)
    text +=
        fmt::format("{}{} {} ({})", text.empty() ? "" : "; ", all[i].spec(), all[i].name, all[i].platform);
  return text;
}

std::optional<int> number(std::string_view text) {
  if (text.empty() || text.size() > 4 || text.find_first_not_of("0123456789") != std::string_view::npos)
    return {};
  return std::stoi(std::string(text));
}

// Returns the devices that match "PLATFORM:INDEX", or an empty optional if `wanted` does not have this form.
// PLATFORM is the platform's index, a part of its name, or the short name that the OpenCL loader gives it.
std::optional<std::vector<std::size_t>> by_platform(const std::vector<DeviceInfo>& all,
                                                    std::string_view wanted) {
  const auto colon = wanted.rfind(':');
  if (colon == std::string_view::npos || colon == 0) return {};
  const std::string_view platform = wanted.substr(0, colon);
  const auto index = number(wanted.substr(colon + 1));
  if (!index) return {};
  return matching(all, [&](const DeviceInfo& info) {
    if (info.device_index != *index) return false;
    const auto platform_index = number(platform);
    return platform_index ? info.platform_index == *platform_index : is_platform(info, platform);
  });
}

// Returns the devices whose complete name is `wanted`. If no device has this name, returns the devices whose
// name contains `wanted`. If no device's name contains `wanted`, returns the devices of the platforms whose
// name contains `wanted` or whose short name is `wanted`.
std::vector<std::size_t> by_name(const std::vector<DeviceInfo>& all, std::string_view wanted) {
  const Test tests[] = {[&](const DeviceInfo& info) { return iequals(info.name, wanted); },
                        [&](const DeviceInfo& info) { return icontains(info.name, wanted); },
                        [&](const DeviceInfo& info) { return is_platform(info, wanted); }};
  for (const Test& test : tests)
    if (auto found = matching(all, test); !found.empty()) return found;
  return {};
}

}  // namespace

std::size_t choose(const std::vector<DeviceInfo>& all, std::string_view wanted, std::string_view origin) {
  if (const char* named = std::getenv("POCL_DEVICES"); all.empty() && named && *named != '\0')
    throw NoDeviceError(fmt::format(
        "no OpenCL device found: the environment variable POCL_DEVICES is '{}', which may name none; unset it, or give basic or pthread",
        named));
  if (all.empty())
    throw NoDeviceError(
        "no OpenCL device found: install a driver (Debian: pocl-opencl-icd for the CPU, nvidia-opencl-icd for NVIDIA) and check that clinfo lists it");
  if (wanted.empty()) {
    if (auto gpus = matching(all, &DeviceInfo::gpu); !gpus.empty()) return gpus.front();
    if (auto cpus = matching(all, &DeviceInfo::cpu); !cpus.empty()) return cpus.front();
    return 0;
  }
  auto by_index = by_platform(all, wanted);
  const std::vector<std::size_t> found = by_index ? *std::move(by_index) : by_name(all, wanted);
  if (found.size() == 1) return found.front();
  if (found.empty())
    throw InputError(fmt::format("{} {}: no such device; available: {}", origin, wanted,
                                 described(all, matching(all, [](const DeviceInfo&) { return true; }))));
  throw InputError(fmt::format("{} {}: several devices match; write one of these as PLATFORM:INDEX: {}",
                               origin, wanted, described(all, found)));
}

}  // namespace pelage::cl
