#include "harness/cl/drivers.hpp"

#include <CL/cl.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "harness/cl/kernel_cache.hpp"

namespace pelage::cl {
namespace {

namespace fs = std::filesystem;

constexpr const char* usual_folders[] = {"/usr/lib/x86_64-linux-gnu",
                                         "/usr/lib/x86_64-linux-gnu/nvidia/current",
                                         "/usr/lib64",
                                         "/usr/lib64/nvidia",
                                         "/usr/lib/aarch64-linux-gnu",
                                         "/usr/local/nvidia/lib64",
                                         "/usr/lib/wsl/lib",
                                         "/run/opengl-driver/lib"};

void append(std::vector<fs::path>& folders, const std::string& list) {
  std::istringstream stream(list);
  for (std::string folder; std::getline(stream, folder, ':');)
    if (!folder.empty()) folders.emplace_back(folder);
}

std::vector<fs::path> driver_folders() {
  std::vector<fs::path> folders;
  append(folders, environment("PELAGE_DRIVERS"));
  if (!folders.empty()) return folders;
  append(folders, environment("LD_LIBRARY_PATH"));
  folders.insert(folders.end(), std::begin(usual_folders), std::end(usual_folders));
  return folders;
}

fs::path vendor_folder() {
  const std::string given = environment("OPENCL_VENDOR_PATH");
  return given.empty() ? "/etc/OpenCL/vendors" : given;
}

}  // namespace

std::optional<fs::path> nvidia_library(const std::vector<fs::path>& folders) {
  const std::string stem = "libnvidia-opencl.so.";
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    if (fs::exists(folder / (stem + "1"), ignored)) return folder / (stem + "1");
    for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
         entry.increment(ignored))
      if (entry->path().filename().string().starts_with(stem)) return entry->path();
  }
  return {};
}

bool names_nvidia(const fs::path& vendors) {
  std::error_code ignored;
  for (fs::directory_iterator entry(vendors, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (entry->path().extension() != ".icd") continue;
    std::ifstream stream(entry->path());
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (text.find("nvidia") != std::string::npos) return true;
  }
  return false;
}

bool may_pin(const std::vector<int>& cores, int online) {
  for (std::size_t i = 0; i < cores.size(); ++i)
    if (cores[i] != int(i)) return false;
  return int(cores.size()) == online;
}

void pin_threads() {
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return;
  std::vector<int> cores;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &set)) cores.push_back(i);
  // PoCL ends the process if it cannot pin a thread to a core of its own.
  if (std::atoi(environment("POCL_MAX_PTHREAD_COUNT").c_str()) > int(cores.size())) return;
  if (may_pin(cores, int(::sysconf(_SC_NPROCESSORS_ONLN)))) ::setenv("POCL_AFFINITY", "1", 0);
}

void announce_drivers() {
  static const bool done = [] {
    pin_threads();
    need_kernel_cache();
    explain_aborts();
    const fs::path vendors = vendor_folder();
    if (!environment("OCL_ICD_VENDORS").empty() || names_nvidia(vendors)) return true;
    const std::optional<fs::path> library = nvidia_library(driver_folders());
    if (!library) return true;
    std::error_code failed;
    const fs::path folder =
        fs::temp_directory_path(failed) / ("pelage-vendors-" + std::to_string(::getpid()));
    if (failed || !fs::create_directories(folder, failed)) return true;
    for (fs::directory_iterator entry(vendors, failed), end; !failed && entry != end; entry.increment(failed))
      fs::copy_file(entry->path(), folder / entry->path().filename(), failed);
    std::ofstream(folder / "nvidia.icd") << fs::absolute(*library).string() << '\n';
    // The OpenCL loader searches the folder in OPENCL_VENDOR_PATH for driver entries (*.icd), but only during
    // its first call. The code therefore deletes the folder after this call. It also restores the variable's
    // old value, because child processes inherit the variable and would search the deleted folder.
    const std::string before = environment("OPENCL_VENDOR_PATH");
    ::setenv("OPENCL_VENDOR_PATH", folder.c_str(), 1);
    cl_uint count = 0;
    clGetPlatformIDs(0, nullptr, &count);
    before.empty() ? ::unsetenv("OPENCL_VENDOR_PATH") : ::setenv("OPENCL_VENDOR_PATH", before.c_str(), 1);
    fs::remove_all(folder, failed);
    return true;
  }();
  (void)done;
}

}  // namespace pelage::cl
