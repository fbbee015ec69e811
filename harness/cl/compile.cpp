#include "harness/cl/compile.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <future>
#include <string>
#include <system_error>
#include <thread>

#include "harness/cl/kernel_cache.hpp"
#include "harness/hash.hpp"
#include "harness/isolated/isolated.hpp"

namespace pelage::cl {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> allowed = false;
constexpr unsigned limit_s = 60;  // for the build of a program, and for a kernel

// Without a build option, which would make it another program, PoCL does not tell what a parameter is. It
// accepts a number only with the size of the parameter, and a struct with any size.
void set_argument(cl_kernel kernel, cl_uint index, const Memory& memory) {
  static constexpr std::array<char, 4096> zeros{};
  constexpr std::size_t local_bytes = std::size_t(1) << 14;
  if (clSetKernelArg(kernel, index, local_bytes, nullptr) == CL_SUCCESS) return;
  for (std::size_t bytes = zeros.size(); bytes > 0; --bytes)
    if (bytes != sizeof(cl_mem) && clSetKernelArg(kernel, index, bytes, zeros.data()) == CL_SUCCESS) return;
  const cl_mem object = memory.get();  // no kernel has a number of this size
  clSetKernelArg(kernel, index, sizeof object, static_cast<const void*>(&object));
}

void compile_all(const Device& device, const BuiltProgram& built) {
  cl_uint count = 0;
  check(clCreateKernelsInProgram(built.program.get(), 0, nullptr, &count), "clCreateKernelsInProgram");
  std::vector<cl_kernel> kernels(count);
  check(clCreateKernelsInProgram(built.program.get(), count, kernels.data(), nullptr),
        "clCreateKernelsInProgram");
  const Queue queue(device);
  const std::vector<char> zeros(std::size_t(1) << 20);
  Memory memory(device, zeros.size());
  for (const cl_kernel kernel : kernels) {
    ::alarm(limit_s);
    // A kernel may write counts, with which the next kernel would leave the memory.
    memory.write(queue, zeros.data(), zeros.size());
    std::array<std::size_t, 3> required{};
    check(clGetKernelWorkGroupInfo(kernel, device.id(), CL_KERNEL_COMPILE_WORK_GROUP_SIZE, sizeof required,
                                   required.data(), nullptr),
          "clGetKernelWorkGroupInfo");
    const std::size_t group = required[0] > 0 ? required[0] : usual_group(device.info());
    cl_uint arguments = 0;
    check(clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof arguments, &arguments, nullptr),
          "clGetKernelInfo");
    for (cl_uint i = 0; i < arguments; ++i) set_argument(kernel, i, memory);
    clEnqueueNDRangeKernel(queue.get(), kernel, 1, nullptr, &group, &group, 0, nullptr, nullptr);
    queue.finish();
  }
}

// The file that says that a process has begun with the program.
fs::path note_of(const fs::path& cache, const DeviceInfo& device, const ProgramText& text) {
  return cache / ("pelage-" + Hash().text(device.name).text(device.driver).text(build_key(text)).hex());
}

}  // namespace

void allow_processes() {
  allowed = true;
}

void compile_elsewhere(const Device& device, const std::vector<ProgramText>& texts) {
  const DeviceInfo& info = device.info();
  const fs::path cache = kernel_cache();
  if (!allowed || !info.cpu || info.platform.find("Portable Computing Language") == std::string::npos ||
      cache.empty())
    return;
  std::error_code failed;
  std::vector<std::string> words{fs::read_symlink("/proc/self/exe", failed).string(),
                                 std::string(compile_word), info.spec(), kernel_folder().string()};
  std::size_t count = 0;
  for (const ProgramText& text : texts) {
    if (fs::exists(note_of(cache, info, text), failed)) continue;
    words.insert(words.end(), {text.file, text.options});
    ++count;
  }
  count = std::min<std::size_t>(count, std::max(1u, std::thread::hardware_concurrency()));
  std::vector<std::future<ProgramOutcome>> processes;
  while (processes.size() < count)
    processes.push_back(std::async(std::launch::async, [&] { return run_program(words); }));
  for (std::future<ProgramOutcome>& process : processes) process.wait();
}

int compile_kernels(std::span<char* const> words) {
  if (words.size() < 2) return 2;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  // Before this process began, pelage set 1, with which the threads of all processes would share cores.
  ::setenv("POCL_AFFINITY", "0", 1);
  try {
    const Device device = choose_device(words[0]);
    set_kernel_folder(words[1]);
    for (std::size_t i = 2; i + 1 < words.size(); i += 2) {
      const ProgramText text{words[i], words[i + 1]};
      const fs::path note = note_of(kernel_cache(), device.info(), text);
      const int file = ::open(note.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
      if (file < 0) continue;  // another process has begun with it
      ::close(file);
      ::alarm(limit_s);
      compile_all(device, *build_program(device, text));
    }
    return 0;
  } catch (const std::exception&) {
    return 1;
  }
}

}  // namespace pelage::cl
