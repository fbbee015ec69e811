#include "harness/cl/kernel_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <system_error>

namespace pelage::cl {
namespace {

namespace fs = std::filesystem;

std::string crash_advice;  // text that the signal handler prints; set before the handler is installed

extern "C" void explain(int signal) {
  // A signal handler may call write(), but not printf().
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, crash_advice.data(), crash_advice.size());
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

fs::path kernel_cache() {
  if (const std::string given = environment("POCL_CACHE_DIR"); !given.empty()) return given;
  if (const std::string given = environment("XDG_CACHE_HOME"); !given.empty())
    return fs::path(given) / "pocl/kcache";
  if (const std::string home = environment("HOME"); !home.empty())
    return fs::path(home) / ".cache/pocl/kcache";
  return {};
}

std::string kernel_cache_fault(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed || ::access(folder.c_str(), W_OK | X_OK) != 0) return "cannot be written";
  const fs::space_info space = fs::space(folder, failed);
  if (failed || space.available >= least_kernel_space) return {};
  return fmt::format("has only {} KiB of free disk space", space.available >> 10);
}

void need_kernel_cache() {
  // PoCL aborts if POCL_CACHE_DIR is set but empty.
  if (environment("POCL_CACHE_DIR").empty()) ::unsetenv("POCL_CACHE_DIR");
  const fs::path wanted = kernel_cache();
  if (wanted.empty()) return;
  const std::string fault = kernel_cache_fault(wanted);
  if (fault.empty()) return;
  std::error_code failed;
  std::string folder = (fs::temp_directory_path(failed) / "pelage-kernels-XXXXXX").string();
  if (failed || ::mkdtemp(folder.data()) == nullptr) {
    fmt::print(stderr, "pelage: {} {}; PoCL needs this folder for compiled kernels\n", wanted.string(),
               fault);
    return;
  }
  ::setenv("POCL_CACHE_DIR", folder.c_str(), 1);
  fmt::print(stderr, "pelage: {} {}; PoCL keeps compiled kernels in a temporary folder\n", wanted.string(),
             fault);
  static const fs::path temporary = folder;
  std::atexit([] {
    std::error_code ignored;
    fs::remove_all(temporary, ignored);
  });
}

void explain_aborts() {
  const fs::path folder = kernel_cache();
  if (folder.empty()) return;
  crash_advice = fmt::format(
      "pelage: the program was aborted, probably by PoCL because a file in its folder of compiled kernels is damaged; delete this folder and run the command again: {}\n",
      folder.string());
  std::signal(SIGABRT, explain);
  std::signal(SIGBUS, explain);
}

}  // namespace pelage::cl
