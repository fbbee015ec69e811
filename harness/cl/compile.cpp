#include "harness/cl/compile.hpp"

#include <fcntl.h>
#include <sched.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include "harness/cl/kernel_cache.hpp"
#include "harness/hash.hpp"

namespace pelage::cl {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> allowed = false;
constexpr unsigned limit_s = 60;  // for the build of a program, and for a kernel

void compile_all(const Device& device, const ProgramText& text) {
  const Program program(device, text);
  std::string names(std::size_t(1) << 14, '\0');  // separated by semicolons
  check(clGetProgramInfo(program.get(), CL_PROGRAM_KERNEL_NAMES, names.size(), names.data(), nullptr),
        "clGetProgramInfo");
  std::istringstream list(names.c_str());
  const Queue queue(device);
  const std::vector<char> zeros(std::size_t(1) << 20);
  Memory memory(device, zeros.size());
  for (std::string name; std::getline(list, name, ';');) {
    ::alarm(limit_s);
    // A kernel may write counts, with which the next kernel would leave the memory.
    memory.write(queue, zeros.data(), zeros.size());
    Kernel(program, name).with_zeros(memory).enqueue(queue, 1);
    queue.finish();
  }
}

int cores() {
  cpu_set_t set;
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

bool can_compile(const DeviceInfo& device, const fs::path& cache) {
  // In a path with a space, each build has an include folder of its own (IncludePath in program.cpp), so PoCL
  // would not find what another process compiled.
  return allowed && device.cpu && device.platform.find("Portable Computing Language") != std::string::npos &&
         !cache.empty() && kernel_cache_fault(cache).empty() && environment("POCL_KERNEL_CACHE") != "0" &&
         kernel_folder().string().find(' ') == std::string::npos;
}

pid_t start(std::vector<std::string> words, int input) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  for (const int output : {STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = -1;
  const int failed = ::posix_spawn(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return failed ? -1 : process;
}

}  // namespace

void allow_processes() {
  allowed = true;
}

CompileProcesses::CompileProcesses(const Device& device, const std::vector<ProgramText>& texts) {
  const DeviceInfo& info = device.info();
  const fs::path cache = kernel_cache();
  if (!can_compile(info, cache)) return;
  std::error_code failed;
  std::vector<std::string> words{fs::read_symlink("/proc/self/exe", failed).string(),
                                 std::string(compile_word), info.spec(), kernel_folder().string()};
  std::string queue;  // an index is a byte, so there are at most 127
  for (const ProgramText& text : texts) {
    const Hash hash = Hash().text(info.name).text(info.driver).text(build_key(text));
    const fs::path note = cache / ("pelage-" + hash.hex());
    if (fs::exists(note, failed) || std::find(notes_.begin(), notes_.end(), note) != notes_.end()) continue;
    queue += char(notes_.size());
    notes_.push_back(note);
    words.insert(words.end(), {text.file, text.options});
  }
  const std::size_t count = std::min<std::size_t>(queue.size(), std::size_t(cores()));
  std::array<int, 2> ends{};
  if (count < 2 || queue.size() > 127 || ::pipe2(ends.data(), O_CLOEXEC) != 0) return;
  if (::write(ends[1], queue.data(), queue.size()) == ssize_t(queue.size()))
    for (std::size_t i = 0; i < count; ++i)
      if (const pid_t process = start(words, ends[0]); process > 0) processes_.push_back(process);
  for (const int end : ends) ::close(end);
}

CompileProcesses::~CompileProcesses() {
  stop();
  wait();
}

void CompileProcesses::wait() {
  // A process that has ended keeps its id until it is reaped, so stop() kills no other process.
  siginfo_t ended;
  for (const pid_t process : processes_)
    while (::waitid(P_PID, id_t(process), &ended, WEXITED | WNOWAIT) != 0 && errno == EINTR) continue;
  const std::lock_guard guard(lock_);
  for (const pid_t process : processes_) ::waitpid(process, nullptr, 0);
  if (!processes_.empty() && !stopped_)
    for (const fs::path& note : notes_) std::ofstream(note).put('\n');
  processes_.clear();
}

void CompileProcesses::stop() {
  const std::lock_guard guard(lock_);
  stopped_ = true;
  for (const pid_t process : processes_) ::kill(process, SIGKILL);
}

int compile_kernels(std::span<char* const> words) {
  if (words.size() < 2) return 2;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGALRM, SIG_DFL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  // Before this process began, pelage set 1, with which the threads of all processes would share cores.
  ::setenv("POCL_AFFINITY", "0", 1);
  try {
    const Device device = choose_device(words[0]);
    set_kernel_folder(words[1]);
    const std::span<char* const> texts = words.subspan(2);
    char index = 0;
    while (::read(STDIN_FILENO, &index, 1) == 1) {
      const std::size_t at = 2 * std::size_t(index);
      if (at + 1 >= texts.size()) return 2;
      ::alarm(limit_s);
      compile_all(device, {texts[at], texts[at + 1]});
    }
    return 0;
  } catch (const std::exception&) {
    return 1;
  }
}

}  // namespace pelage::cl
