#include "harness/cl/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iterator>
#include <mutex>

#include "harness/cl/buffer.hpp"
#include "harness/cl/builds.hpp"
#include "harness/cl/drivers.hpp"
#include "harness/error.hpp"

namespace pelage::cl {

struct Device::State {
  cl_device_id id = nullptr;
  DeviceInfo info;
  std::string platform_suffix;  // short name such as POCL, NV or MESA; empty without the extension cl_khr_icd
  // The context is created on its first use, because listing the devices must not occupy every GPU of a
  // shared machine.
  mutable std::once_flag created;
  mutable Owned<cl_context, clReleaseContext> context;
  mutable Builds builds;
};

namespace {

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || std::isspace(static_cast<unsigned char>(text.back())) != 0))
    text.pop_back();
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? std::string{} : text.substr(first);
}

std::string platform_text(cl_platform_id platform, cl_platform_info key) {
  std::size_t size = 0;
  if (clGetPlatformInfo(platform, key, 0, nullptr, &size) != CL_SUCCESS || size == 0) return {};
  std::string text(size, '\0');
  if (clGetPlatformInfo(platform, key, size, text.data(), nullptr) != CL_SUCCESS) return {};
  return trimmed(text);
}

std::string device_text(cl_device_id device, cl_device_info key) {
  std::size_t size = 0;
  if (clGetDeviceInfo(device, key, 0, nullptr, &size) != CL_SUCCESS || size == 0) return {};
  std::string text(size, '\0');
  if (clGetDeviceInfo(device, key, size, text.data(), nullptr) != CL_SUCCESS) return {};
  return trimmed(text);
}

template <class T>
T device_value(cl_device_id device, cl_device_info key) {
  T value{};
  if (clGetDeviceInfo(device, key, sizeof value, &value, nullptr) != CL_SUCCESS) return T{};
  return value;
}

// Returns the number of lanes, which are the vector elements that a work-item computes at once. Sixteen lanes
// are faster than one lane only on CPU devices of PoCL. The other tested compilers generate slow code for
// sixteen lanes.
int lanes_of(const DeviceInfo& info) {
  if (const char* forced = std::getenv("PELAGE_LANES"); forced != nullptr && *forced != '\0') {
    const std::string_view value = forced;
    if (value != "1" && value != "16")
      throw InputError(fmt::format("PELAGE_LANES is '{}': it may be 1 or 16", value));
    return value == "16" ? 16 : 1;
  }
  return info.cpu && info.platform == "Portable Computing Language" ? 16 : 1;
}

DeviceInfo describe(cl_platform_id platform, cl_device_id device) {
  DeviceInfo info;
  info.platform = platform_text(platform, CL_PLATFORM_NAME);
  info.platform_suffix = platform_text(platform, 0x0920);  // CL_PLATFORM_ICD_SUFFIX_KHR
  info.platform_version = platform_text(platform, CL_PLATFORM_VERSION);
  info.name = device_text(device, CL_DEVICE_NAME);
  info.vendor = device_text(device, CL_DEVICE_VENDOR);
  info.version = device_text(device, CL_DEVICE_VERSION);
  info.c_version = device_text(device, CL_DEVICE_OPENCL_C_VERSION);
  info.driver = device_text(device, CL_DRIVER_VERSION);
  const auto type = device_value<cl_device_type>(device, CL_DEVICE_TYPE);
  info.gpu = (type & CL_DEVICE_TYPE_GPU) != 0;
  info.cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
  info.compute_units = device_value<cl_uint>(device, CL_DEVICE_MAX_COMPUTE_UNITS);
  info.global_memory = device_value<cl_ulong>(device, CL_DEVICE_GLOBAL_MEM_SIZE);
  info.local_memory = device_value<cl_ulong>(device, CL_DEVICE_LOCAL_MEM_SIZE);
  info.max_allocation = device_value<cl_ulong>(device, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
  info.max_work_group = device_value<std::size_t>(device, CL_DEVICE_MAX_WORK_GROUP_SIZE);
  info.timer_resolution_ns = device_value<std::size_t>(device, CL_DEVICE_PROFILING_TIMER_RESOLUTION);
  info.fp64 = device_value<cl_device_fp_config>(device, CL_DEVICE_DOUBLE_FP_CONFIG) != 0;
  info.lanes = lanes_of(info);
  return info;
}

std::vector<cl_platform_id> platform_ids() {
  announce_drivers();
  cl_uint count = 0;
  // If there is no platform, the loader returns the error -1001 (no platform found) instead of the count 0.
  const cl_int code = clGetPlatformIDs(0, nullptr, &count);
  if (code == -1001 || count == 0) return {};
  check(code, "clGetPlatformIDs");
  std::vector<cl_platform_id> ids(count);
  check(clGetPlatformIDs(count, ids.data(), nullptr), "clGetPlatformIDs");
  return ids;
}

std::vector<cl_device_id> device_ids(cl_platform_id platform) {
  cl_uint count = 0;
  // If this call fails, the function returns no devices of this platform, and the other platforms remain
  // usable.
  if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count) != CL_SUCCESS || count == 0) return {};
  std::vector<cl_device_id> ids(count);
  if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, ids.data(), nullptr) != CL_SUCCESS) return {};
  return ids;
}

}  // namespace

Device::Device(std::shared_ptr<const State> state) : state_(std::move(state)) {}

const DeviceInfo& Device::info() const {
  return state_->info;
}

cl_device_id Device::id() const {
  return state_->id;
}

cl_context Device::context() const {
  std::call_once(state_->created, [this] {
    cl_int code = CL_SUCCESS;
    state_->context.reset(clCreateContext(nullptr, 1, &state_->id, nullptr, nullptr, &code));
    check(code, fmt::format("clCreateContext on {}", info().name));
  });
  return state_->context.get();
}

Builds& Device::builds() const {
  return state_->builds;
}

std::string DeviceInfo::spec() const {
  return fmt::format("{}:{}", platform_index, device_index);
}

std::vector<PlatformInfo> platforms() {
  std::vector<PlatformInfo> found;
  for (cl_platform_id id : platform_ids())
    found.push_back({platform_text(id, CL_PLATFORM_NAME), platform_text(id, CL_PLATFORM_VERSION),
                     static_cast<int>(found.size()), static_cast<int>(device_ids(id).size())});
  return found;
}

std::vector<Device> devices() {
  std::vector<Device> found;
  int platform_index = 0;
  for (cl_platform_id platform : platform_ids()) {
    int device_index = 0;
    for (cl_device_id id : device_ids(platform)) {
      auto state = std::make_shared<Device::State>();
      state->id = id;
      state->info = describe(platform, id);
      state->info.platform_index = platform_index;
      state->info.device_index = device_index++;
      found.push_back(Device(std::move(state)));
    }
    ++platform_index;
  }
  return found;
}

Device choose_device(std::string_view wanted) {
  const std::vector<Device> all = devices();
  std::vector<DeviceInfo> infos;
  std::transform(all.begin(), all.end(), std::back_inserter(infos), [](const Device& d) { return d.info(); });
  const char* variable = std::getenv("PELAGE_DEVICE");
  if (wanted.empty() && variable != nullptr) return all[choose(infos, variable, "PELAGE_DEVICE")];
  return all[choose(infos, wanted, "--device")];
}

}  // namespace pelage::cl
