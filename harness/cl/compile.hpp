// Compiles the kernels of a program in another process. PoCL compiles one kernel of a process at a time, but
// several processes that share its folder of compiled kernels compile in parallel.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// The first argument of a process that compile_elsewhere() starts.
inline constexpr std::string_view compile_word = "compile-kernels";

/// Permits compile_elsewhere() to start this program again. The program must then pass its arguments to
/// compile_kernels() if the first argument is `compile_word`.
void allow_processes();

/// Starts a process that compiles the program and its kernels into kernel_cache(), and waits for its end.
/// Starts no process if allow_processes() was not called, if the device is not a CPU device of PoCL, or if a
/// process with the same `key` (build_key()) has ended before. A file "pelage-HASH" in kernel_cache() records
/// the end. A process that fails prints nothing: the caller meets the error when it builds the program.
void compile_elsewhere(const Device& device, const ProgramText& text, const std::string& key);

/// The work of the process: builds the program and launches each of its kernels over one work-group, with
/// numbers and memory of zeros, because PoCL compiles a kernel at its launch. `words`: the arguments after
/// `compile_word`. Returns the exit code of the process. A process that takes more than 120 s is killed.
int compile_kernels(std::span<char* const> words);

}  // namespace pelage::cl
