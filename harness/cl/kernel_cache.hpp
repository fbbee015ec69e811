// The folder in which PoCL keeps compiled kernels. PoCL reports no device if the folder is not writable, ends
// the process if its disk is full, and crashes if a file in it is damaged.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace pelage::cl {

/// Returns the folder in which PoCL keeps compiled kernels: $POCL_CACHE_DIR; if this variable is not set,
/// $XDG_CACHE_HOME/pocl/kcache; otherwise $HOME/.cache/pocl/kcache. The path is empty if none of these three
/// variables is set.
std::filesystem::path kernel_cache();

/// Free space in bytes that the folder must have. The compiled kernels of one experiment take a few MiB.
inline constexpr std::uintmax_t least_kernel_space = std::uintmax_t(16) << 20;

/// Returns why PoCL cannot use the folder: it is not writable, or its disk has less free space than
/// least_kernel_space. Returns "" if PoCL can use the folder. Creates the folder if it does not exist.
std::string kernel_cache_fault(const std::filesystem::path& folder);

/// If kernel_cache() has a fault, sets POCL_CACHE_DIR to a new temporary folder and prints a message to
/// stderr. The temporary folder is deleted when the program ends.
void need_kernel_cache();

/// From now on, if the process receives SIGABRT or SIGBUS, a line on stderr advises to delete kernel_cache(),
/// because PoCL aborts if a file in it is damaged. The signal then ends the process as before.
void explain_aborts();

}  // namespace pelage::cl
