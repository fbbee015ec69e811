// The folder in which PoCL keeps compiled kernels. If the folder is not writable, PoCL reports no device. If
// the disk is full, PoCL ends the process. If a file in the folder is damaged, PoCL crashes.
#pragma once
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace pelage::cl {

/// Returns the value of an environment variable; "" if it is not set.
inline std::string environment(const char* variable) {
  const char* value = std::getenv(variable);
  return value ? value : "";
}

/// Returns the folder in which PoCL keeps compiled kernels: $POCL_CACHE_DIR; if this variable is not set,
/// $XDG_CACHE_HOME/pocl/kcache; otherwise $HOME/.cache/pocl/kcache. The path is empty if none of these three
/// variables is set.
std::filesystem::path kernel_cache();

/// pelage lets PoCL use the folder kernel_cache() only if its disk has at least this much free space, in
/// bytes. The compiled kernels of one experiment take a few MiB.
inline constexpr std::uintmax_t least_kernel_space = std::uintmax_t(16) << 20;

/// Returns a description of the fault if the folder is not writable or its disk has less free space than
/// least_kernel_space. Returns "" if PoCL can use the folder. Creates the folder if it does not exist.
std::string kernel_cache_fault(const std::filesystem::path& folder);

/// If PoCL cannot use the folder kernel_cache(), sets POCL_CACHE_DIR to a new temporary folder and prints a
/// message on stderr. The temporary folder is deleted when the program ends.
void need_kernel_cache();

/// Installs handlers for SIGABRT and SIGBUS. PoCL causes these signals if a file in the folder kernel_cache()
/// is damaged. A handler prints a line on stderr that advises the user to delete this folder. Then the signal
/// ends the process.
void explain_aborts();

}  // namespace pelage::cl
