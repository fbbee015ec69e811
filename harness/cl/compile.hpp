// Compiles the kernels of programs in other processes. PoCL compiles one kernel of a process at a time, but
// several processes that share its folder of compiled kernels compile in parallel.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <mutex>
#include <span>
#include <string_view>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// The first argument of a process that a CompileProcesses starts.
inline constexpr std::string_view compile_word = "compile-kernels";

/// Permits CompileProcesses to start this program again. The program must then pass its arguments to
/// compile_kernels() if the first argument is `compile_word`.
void allow_processes();

/// Processes that compile programs and their kernels into kernel_cache(). They print nothing and report no
/// failures: the caller meets these when it builds the programs.
class CompileProcesses {
 public:
  /// Starts one process per core or per program, whichever is fewer. Starts none if there would be only one,
  /// if allow_processes() was not called, or if the device is not a CPU device of PoCL with a usable cache.
  /// Leaves out programs that earlier processes compiled: files "pelage-HASH" in the cache record these.
  CompileProcesses(const Device& device, const std::vector<ProgramText>& texts);
  ~CompileProcesses();  ///< calls stop() and wait()
  CompileProcesses(const CompileProcesses&) = delete;
  CompileProcesses& operator=(const CompileProcesses&) = delete;
  void wait();  ///< waits until all processes have ended
  void stop();  ///< kills the processes; another thread may call it during wait()

 private:
  std::mutex lock_;
  std::vector<pid_t> processes_;
  std::vector<std::filesystem::path> notes_;
  bool stopped_ = false;
};

/// The work of a process: builds programs and launches each of their kernels over one work-group of the usual
/// size, with numbers and memory of zeros, because PoCL compiles a kernel at its launch, for the size of the
/// groups. A kernel with groups of another size (the mapping `pixel`, tuned sizes) remains for the caller.
/// `words`: the arguments after `compile_word`. Each byte on stdin is the index of a program among them.
/// Returns the exit code of the process. If a build or a kernel takes more than 60 s, the process is killed.
int compile_kernels(std::span<char* const> words);

}  // namespace pelage::cl
