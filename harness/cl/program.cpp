#include "harness/cl/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <mutex>

#include "harness/atomic_file.hpp"
#include "harness/cl/builds.hpp"
#include "harness/cl/kernel_cache.hpp"
#include "harness/error.hpp"

namespace pelage::cl {
namespace fs = std::filesystem;
namespace {

std::string build_log(cl_program program, cl_device_id device) {
  std::size_t size = 0;
  if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size) != CL_SUCCESS ||
      size == 0)
    return {};
  std::string log(size, '\0');
  if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr) != CL_SUCCESS)
    return {};
  while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
  return log;
}

// Drivers split build options at spaces, and PoCL does not parse quotes. If the path of the kernel folder
// contains a space, the option -I therefore names a symbolic link to the folder. The link exists until the
// build ends.
class IncludePath {
 public:
  explicit IncludePath(const fs::path& folder) : path_(folder) {
    if (folder.string().find(' ') == std::string::npos) return;
    std::string name = (temporary_folder() / "pelage-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw DeviceError(fmt::format("{}: cannot be created", name));
    parent_ = name;
    path_ = parent_ / "kernels";
    fs::create_directory_symlink(folder, path_);
  }
  ~IncludePath() {
    std::error_code ignored;
    if (!parent_.empty()) fs::remove_all(parent_, ignored);
  }
  IncludePath(const IncludePath&) = delete;
  IncludePath& operator=(const IncludePath&) = delete;
  std::string text() const { return path_.string(); }

 private:
  fs::path path_, parent_;
};

std::string cache_advice(const BuiltProgram& built) {
  const fs::path folder = built.by_pocl ? kernel_cache() : fs::path();
  if (folder.empty()) return {};
  return fmt::format(
      "; if the kernels are those of pelage, a file in PoCL's folder of compiled kernels is probably damaged: delete this folder and run the command again: {}",
      folder.string());
}

std::shared_ptr<const BuiltProgram> build(const Device& device, const ProgramText& text,
                                          const SourceTexts& sources) {
  // PoCL builds one program of a context at a time anyway. The lock also protects the text that
  // explain_aborts() sets.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const fs::path folder = kernel_folder();
  const IncludePath include(folder);
  const std::string& source = sources.at(text.file);
  auto built = std::make_shared<BuiltProgram>();
  built->text = text;
  built->by_pocl = device.info().platform.find("Portable Computing Language") != std::string::npos;
  built->sources = hashes_of(sources);
  const char* source_text = source.data();
  const std::size_t length = source.size();
  std::string all =
      fmt::format("-cl-std=CL1.2 -I {}{}{}", include.text(), text.options.empty() ? "" : " ", text.options);
  // NVIDIA's cache of binaries does not detect changes in included files. The hash of these files is part of
  // the options, so the driver compiles again after a change.
  if (device.info().platform.find("NVIDIA") != std::string::npos)
    all += " -D PELAGE_KERNELS=0x" + hash_of(built->sources);

  const auto start = std::chrono::steady_clock::now();
  cl_int code = CL_SUCCESS;
  built->program.reset(clCreateProgramWithSource(device.context(), 1, &source_text, &length, &code));
  check(code, "clCreateProgramWithSource");
  const cl_device_id id = device.id();
  // PoCL uses LLVM, which replaces the signal handlers when it is loaded and when it compiles.
  // explain_aborts() therefore installs pelage's handlers again before and after the compilation.
  explain_aborts();
  code = clBuildProgram(built->program.get(), 1, &id, all.c_str(), nullptr, nullptr);
  explain_aborts();
  built->build_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  built->log = build_log(built->program.get(), id);
  if (code != CL_SUCCESS)
    throw DeviceError(
        fmt::format("clBuildProgram: {}: {} does not build on {} with options '{}'; the log:\n{}",
                    error_name(code), (folder / text.file).string(), device.info().name, all,
                    built->log.empty() ? "(empty)" + cache_advice(*built) : built->log));
  return built;
}

std::string key_of(const ProgramText& text, const SourceTexts& sources) {
  return fmt::format("{}\n{}\n{}\n{}", kernel_folder().string(), text.file,
                     options_read(text.options, sources), hash_of(hashes_of(sources)));
}

}  // namespace

std::string hash_of(const std::vector<const Program*>& programs) {
  Sources all;
  for (const Program* program : programs) all.insert(program->sources().begin(), program->sources().end());
  return hash_of(all);
}

std::string build_key(const ProgramText& text) {
  return key_of(text, source_texts(text.file));
}

std::shared_ptr<const BuiltProgram> build_program(const Device& device, const ProgramText& text) {
  const SourceTexts sources = source_texts(text.file);
  return device.builds().get(key_of(text, sources), [&] {
    return build(device, {text.file, options_read(text.options, sources)}, sources);
  });
}

Program::Program(const Device& device, const ProgramText& text) : built_(build_program(device, text)) {}

std::string Program::cache_advice() const {
  return cl::cache_advice(*built_);
}

std::optional<double> Event::milliseconds(const Device& device) const {
  if (event_ == nullptr || device.info().timer_resolution_ns == 0) return {};
  const cl_event event = event_.get();
  check(clWaitForEvents(1, &event), "clWaitForEvents");
  cl_ulong start = 0, end = 0;
  if (clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start, nullptr) !=
          CL_SUCCESS ||
      clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr) != CL_SUCCESS ||
      end <= start)
    return {};
  return static_cast<double>(end - start) * 1e-6;
}

Kernel::Kernel(const Program& program, const std::string& name) : name_(name) {
  cl_int code = CL_SUCCESS;
  kernel_.reset(clCreateKernel(program.get(), name.c_str(), &code));
  if (code == CL_INVALID_KERNEL_NAME && !program.cache_advice().empty())
    throw DeviceError(fmt::format("clCreateKernel of {}: {}: {} has no such kernel{}", name, error_name(code),
                                  program.file(), program.cache_advice()));
  check(code, fmt::format("clCreateKernel of {}", name));
}

void Kernel::set_memory(cl_uint index, cl_mem memory) {
  check(clSetKernelArg(kernel_.get(), index, sizeof(cl_mem), static_cast<const void*>(&memory)),
        fmt::format("clSetKernelArg {} of {}", index, name_));
}

void Kernel::set_bytes(cl_uint index, std::size_t bytes, const void* value) {
  check(clSetKernelArg(kernel_.get(), index, bytes, value),
        fmt::format("clSetKernelArg {} of {}", index, name_));
}

Kernel& Kernel::with_zeros(const Memory& memory) {
  static constexpr std::array<char, 4096> zeros{};
  constexpr std::size_t local_bytes = std::size_t(1) << 14;
  cl_uint count = 0;
  check(clGetKernelInfo(kernel_.get(), CL_KERNEL_NUM_ARGS, sizeof count, &count, nullptr), "clGetKernelInfo");
  for (cl_uint i = 0; i < count; ++i) {
    // Without a build option, which would make it another program, PoCL does not tell what a parameter is. It
    // accepts a number only with the size of the parameter, and a struct with any size.
    bool done = clSetKernelArg(kernel_.get(), i, local_bytes, nullptr) == CL_SUCCESS;
    for (std::size_t bytes = zeros.size(); !done && bytes > 0; --bytes)
      done = bytes != sizeof(cl_mem) && clSetKernelArg(kernel_.get(), i, bytes, zeros.data()) == CL_SUCCESS;
    if (!done) set_memory(i, memory.get());
  }
  return *this;
}

const Kernel::Groups& Kernel::groups(const Queue& queue) const {
  if (groups_.most > 0) return groups_;
  const auto ask = [&](cl_kernel_work_group_info what, void* value, std::size_t bytes) {
    check(clGetKernelWorkGroupInfo(kernel_.get(), queue.device().id(), what, bytes, value, nullptr),
          fmt::format("clGetKernelWorkGroupInfo of {}", name_));
  };
  std::array<std::size_t, 3> required{};
  std::size_t most = 0;
  ask(CL_KERNEL_COMPILE_WORK_GROUP_SIZE, required.data(), sizeof required);
  ask(CL_KERNEL_WORK_GROUP_SIZE, &most, sizeof most);
  groups_ = {required[0], std::max<std::size_t>(most, 1)};
  return groups_;
}

Event Kernel::launch(const Queue& queue, unsigned dimensions, std::array<std::size_t, 2> items,
                     std::array<std::size_t, 2> group) const {
  // A size that the kernel requires cannot change. If it does not fit, the driver reports the error.
  if (const Groups& sizes = groups(queue); sizes.required == 0)
    while (group[0] * group[1] > sizes.most) group[group[1] > group[0] ? 1 : 0] /= 2;
  for (std::size_t i = 0; i < 2; ++i) items[i] = (items[i] + group[i] - 1) / group[i] * group[i];
  cl_event event = nullptr;
  check(clEnqueueNDRangeKernel(queue.get(), kernel_.get(), dimensions, nullptr, items.data(), group.data(), 0,
                               nullptr, &event),
        fmt::format("clEnqueueNDRangeKernel of {} over {} x {} in groups of {} x {}", name_, items[0],
                    items[1], group[0], group[1]));
  return Event(event, name_, bytes_);
}

Event Kernel::enqueue(const Queue& queue, std::array<std::size_t, 2> items,
                      std::array<std::size_t, 2> group) const {
  return launch(queue, 2, items, group);
}

Event Kernel::enqueue(const Queue& queue, std::size_t items, std::size_t group) const {
  if (group == 0) group = groups(queue).required;
  if (group == 0) group = usual_group(queue.device().info());
  return launch(queue, 1, {items, 1}, {group, 1});
}

Event Kernel::enqueue_loop(const Queue& queue, std::size_t count) const {
  const DeviceInfo& device = queue.device().info();
  const std::size_t most = 32 * std::size_t(device.compute_units) * usual_group(device);
  return enqueue(queue, device.cpu ? std::min(count, most) : count);
}

int whole_exponent(float exponent) {
  const bool whole = exponent >= 1 && exponent <= 1024 && std::floor(exponent) == exponent;
  return whole ? int(exponent) : 0;
}

int lanes_of(const DeviceInfo& device, int wanted) {
  if (wanted != 0 && wanted != 1 && wanted != 16)
    throw InputError(fmt::format("lanes: {}; it must be 0, 1 or 16", wanted));
  return wanted != 0 ? wanted : device.lanes;
}

int units_per_item(const DeviceInfo& device, int lanes, int units, int wanted) {
  if (wanted > 0) return wanted * (16 / lanes);
  if (lanes == 1) return 1;
  const int items = 8 * std::max(1, int(device.compute_units));
  return std::clamp((units + items - 1) / items, 1, 64);
}

std::size_t usual_group(const DeviceInfo& device) {
  return device.lanes > 1 ? 1 : 64;
}

}  // namespace pelage::cl
