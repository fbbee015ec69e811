// OpenCL devices. A function that uses a device receives it as an argument; no global variable holds a
// current device.
#pragma once
#include <CL/cl.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace pelage::cl {

struct DeviceInfo {
  std::string platform_suffix;  ///< the loader's short name of the platform ("POCL", "NV"); may be empty
  std::string platform, platform_version, name, vendor, version, c_version, driver;
  int platform_index = 0, device_index = 0;  ///< device_index: position among the platform's devices, from 0
  bool gpu = false, cpu = false;
  unsigned compute_units = 0;
  std::uint64_t global_memory = 0, local_memory = 0, max_allocation = 0;
  std::size_t max_work_group = 0;
  std::uint64_t timer_resolution_ns = 0;  ///< CL_DEVICE_PROFILING_TIMER_RESOLUTION; 0: no event timer
  bool fp64 = false;
  int lanes = 1;  ///< vector elements per work-item: 16 if this is faster (CPU devices of PoCL), else 1

  std::string spec() const;  ///< platform index and device index, such as "0:0", as --device accepts them
};

/// Owns an object of OpenCL, and calls `release` to release it.
template <auto release>
struct Release {
  template <class T>
  void operator()(T* object) const {
    release(object);
  }
};
template <class Handle, auto release>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release<release>>;

class Builds;

/// A device with its own context. Copies of the object share the device and the context.
class Device {
 public:
  const DeviceInfo& info() const;
  cl_device_id id() const;
  cl_context context() const;
  Builds& builds() const;  ///< the programs that were built for the context

 private:
  struct State;
  std::shared_ptr<const State> state_;
  explicit Device(std::shared_ptr<const State> state);
  friend std::vector<Device> devices();
};

struct PlatformInfo {
  std::string name, version;
  int index = 0;  ///< as in DeviceInfo::platform_index
  /// Number of devices. A platform can have none: Mesa's Clover has none, and rusticl has none if
  /// RUSTICL_ENABLE names no driver.
  int devices = 0;
};

/// Returns every platform that the OpenCL loader knows, in the loader's order. The result is empty if the
/// loader finds no driver.
std::vector<PlatformInfo> platforms();

/// Returns every device of every platform, with the platforms in the loader's order. Platforms without
/// devices are skipped.
std::vector<Device> devices();

/// Returns the device that `wanted` names. `wanted` is "PLATFORM:INDEX" or a part of a device's name.
/// PLATFORM is the index of the platform, a part of its name, or the loader's short name of the platform.
/// INDEX is DeviceInfo::device_index. If no device's name contains `wanted`, the function returns the device
/// of the platform whose name contains `wanted` or whose short name is `wanted`. If `wanted` is empty, the
/// environment variable $PELAGE_DEVICE replaces it. If this variable is empty too, the function returns the
/// first GPU. If there is no GPU, it returns the first CPU. If there is no CPU either, it returns the first
/// device. Throws InputError with the candidates if no device or several devices match, and NoDeviceError if
/// there are no devices.
Device choose_device(std::string_view wanted);

/// Returns the index of the device in the list `all` that choose_device(wanted) chooses. The message of an
/// InputError begins with `origin`, which says where the user gave the text (--device or PELAGE_DEVICE).
std::size_t choose(const std::vector<DeviceInfo>& all, std::string_view wanted, std::string_view origin);

}  // namespace pelage::cl
