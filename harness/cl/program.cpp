#include "harness/cl/program.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <mutex>
#include <utility>

#include "harness/cl/build_ahead.hpp"
#include "harness/cl/kernel_cache.hpp"
#include "harness/error.hpp"
#include "harness/hash.hpp"

namespace pelage::cl {
namespace fs = std::filesystem;
namespace {

std::string read_source(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file))
    throw InputError(
        fmt::format("{}: cannot be read: no such kernel file in the kernel folder", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

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
    std::string name = (fs::temp_directory_path() / "pelage-XXXXXX").string();
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

void add_sources(const fs::path& folder, const std::string& file, Sources& found) {
  if (found.contains(file)) return;
  const std::string text = read_source(folder / file);
  found[file] = Hash().text(text).value();
  constexpr std::string_view include = "#include \"";
  for (auto at = text.find(include); at != std::string::npos; at = text.find(include, at + 1)) {
    const auto begin = at + include.size();
    if (at == 0 || text[at - 1] == '\n')
      add_sources(folder, text.substr(begin, text.find('"', begin) - begin), found);
  }
}

std::string cache_advice(const BuiltProgram& built) {
  const fs::path folder = built.by_pocl ? kernel_cache() : fs::path();
  if (folder.empty()) return {};
  return fmt::format(
      "; if the kernels are those of pelage, a file in PoCL's folder of compiled kernels is probably "
      "damaged: "
      "delete this folder and run the command again: {}",
      folder.string());
}

}  // namespace

Sources sources_of(const fs::path& file) {
  Sources found;
  add_sources(kernel_folder(), file.generic_string(), found);
  return found;
}

std::string hash_of(const Sources& sources) {
  Hash hash;
  for (const auto& [path, contents] : sources) hash.text(path).number(contents);
  return hash.hex();
}

std::string hash_of(const std::vector<const Program*>& programs) {
  Sources all;
  for (const Program* program : programs) all.insert(program->sources().begin(), program->sources().end());
  return hash_of(all);
}

std::map<std::string, std::string> hashes_by_file(const std::vector<const Program*>& programs) {
  std::map<std::string, std::string> hashes;
  for (const Program* program : programs) hashes[program->file()] = hash_of(program->sources());
  return hashes;
}

BuiltProgram::~BuiltProgram() {
  if (program != nullptr) clReleaseProgram(program);
}

std::shared_ptr<const BuiltProgram> build_program(const Device& device, const ProgramText& text) {
  // PoCL builds one program at a time anyway. The lock also protects the text that explain_aborts() sets.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const fs::path folder = kernel_folder();
  const IncludePath include(folder);
  const std::string source = read_source(folder / text.file);
  auto built = std::make_shared<BuiltProgram>();
  built->file = text.file;
  built->by_pocl = device.info().platform.find("Portable Computing Language") != std::string::npos;
  built->sources = sources_of(text.file);
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
  built->program = clCreateProgramWithSource(device.context(), 1, &source_text, &length, &code);
  check(code, "clCreateProgramWithSource");
  const cl_device_id id = device.id();
  // PoCL uses LLVM, which replaces the signal handlers when it is loaded and when it compiles.
  // explain_aborts() therefore installs pelage's handlers again before and after the compilation.
  explain_aborts();
  code = clBuildProgram(built->program, 1, &id, all.c_str(), nullptr, nullptr);
  explain_aborts();
  built->build_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  built->log = build_log(built->program, id);
  if (code != CL_SUCCESS)
    throw DeviceError(
        fmt::format("clBuildProgram: {}: {} does not build on {} with options '{}'; the log:\n{}",
                    error_name(code), (folder / text.file).string(), device.info().name, all,
                    built->log.empty() ? "(empty)" + cache_advice(*built) : built->log));
  return built;
}

Program::Program(const Device& device, const ProgramText& text) : built_(BuildAhead::take(device, text)) {
  if (!built_) built_ = build_program(device, text);
}

std::string Program::cache_advice() const {
  return cl::cache_advice(*built_);
}

Event::~Event() {
  if (event_ != nullptr) clReleaseEvent(event_);
}

Event::Event(Event&& other) noexcept
    : event_(std::exchange(other.event_, nullptr)), kernel_(std::move(other.kernel_)), bytes_(other.bytes_) {}

Event& Event::operator=(Event&& other) noexcept {
  std::swap(event_, other.event_);
  std::swap(kernel_, other.kernel_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

std::optional<double> Event::milliseconds(const Device& device) const {
  if (event_ == nullptr || device.info().timer_resolution_ns == 0) return {};
  check(clWaitForEvents(1, &event_), "clWaitForEvents");
  cl_ulong start = 0, end = 0;
  if (clGetEventProfilingInfo(event_, CL_PROFILING_COMMAND_START, sizeof start, &start, nullptr) !=
          CL_SUCCESS ||
      clGetEventProfilingInfo(event_, CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr) != CL_SUCCESS ||
      end <= start)
    return {};
  return static_cast<double>(end - start) * 1e-6;
}

Kernel::Kernel(const Program& program, const std::string& name) : name_(name) {
  cl_int code = CL_SUCCESS;
  kernel_ = clCreateKernel(program.get(), name.c_str(), &code);
  if (code == CL_INVALID_KERNEL_NAME && !program.cache_advice().empty())
    throw DeviceError(fmt::format("clCreateKernel of {}: {}: {} has no such kernel{}", name, error_name(code),
                                  program.file(), program.cache_advice()));
  check(code, fmt::format("clCreateKernel of {}", name));
}

Kernel::~Kernel() {
  if (kernel_ != nullptr) clReleaseKernel(kernel_);
}

Kernel::Kernel(Kernel&& other) noexcept
    : kernel_(std::exchange(other.kernel_, nullptr)), name_(std::move(other.name_)), bytes_(other.bytes_) {}

Kernel& Kernel::operator=(Kernel&& other) noexcept {
  std::swap(kernel_, other.kernel_);
  std::swap(name_, other.name_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

void Kernel::set_memory(cl_uint index, cl_mem memory) {
  check(clSetKernelArg(kernel_, index, sizeof(cl_mem), static_cast<const void*>(&memory)),
        fmt::format("clSetKernelArg {} of {}", index, name_));
}

void Kernel::set_bytes(cl_uint index, std::size_t bytes, const void* value) {
  check(clSetKernelArg(kernel_, index, bytes, value), fmt::format("clSetKernelArg {} of {}", index, name_));
}

Event Kernel::enqueue(const Queue& queue, std::array<std::size_t, 2> global,
                      std::array<std::size_t, 2> local) const {
  cl_event event = nullptr;
  check(clEnqueueNDRangeKernel(queue.get(), kernel_, 2, nullptr, global.data(),
                               local[0] > 0 ? local.data() : nullptr, 0, nullptr, &event),
        fmt::format("clEnqueueNDRangeKernel of {} over {} x {}", name_, global[0], global[1]));
  return Event(event, name_, bytes_);
}

Event Kernel::enqueue(const Queue& queue, std::size_t global, std::size_t local) const {
  cl_event event = nullptr;
  check(clEnqueueNDRangeKernel(queue.get(), kernel_, 1, nullptr, &global, local > 0 ? &local : nullptr, 0,
                               nullptr, &event),
        fmt::format("clEnqueueNDRangeKernel of {} over {}", name_, global));
  return Event(event, name_, bytes_);
}

}  // namespace pelage::cl
