// Compiles the kernels of programs in other processes. PoCL compiles one kernel of a process at a time, but
// several processes that share its folder of compiled kernels compile in parallel.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// The first argument of a process that compile_elsewhere() starts.
inline constexpr std::string_view compile_word = "compile-kernels";

/// Permits compile_elsewhere() to start this program again. The program must then pass its arguments to
/// compile_kernels() if the first argument is `compile_word`.
void allow_processes();

/// Starts up to one process per core, which compile the programs and their kernels into kernel_cache(), and
/// waits for their end. Starts no process if allow_processes() was not called or if the device is not a CPU
/// device of PoCL. A file "pelage-HASH" in kernel_cache() says that a process has begun with a program; no
/// process begins with it again. Failures are not reported: the caller meets them when it builds the program.
void compile_elsewhere(const Device& device, const std::vector<ProgramText>& texts);

/// The work of a process: builds the programs with which no other process has begun, and launches each of
/// their kernels over one work-group, with numbers and memory of zeros, because PoCL compiles a kernel at its
/// launch. `words`: the arguments after `compile_word`. Returns the exit code of the process. A process that
/// takes more than 60 s for the build of a program or for a kernel is killed.
int compile_kernels(std::span<char* const> words);

}  // namespace pelage::cl
