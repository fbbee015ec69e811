// Searches for the folder of kernel sources.
#include <fmt/format.h>

#include <cstdlib>

#include "harness/cl/program.hpp"
#include "harness/data_folder.hpp"
#include "harness/error.hpp"

namespace pelage::cl {
namespace fs = std::filesystem;
namespace {

// Returns the folder that the option --kernels names, as an absolute path. It is empty without the option.
fs::path& chosen() {
  static fs::path folder;
  return folder;
}

}  // namespace

void set_kernel_folder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw InputError(fmt::format("--kernels {}: no such folder", folder.string()));
  chosen() = fs::absolute(folder);
}

fs::path kernel_folder() {
  if (!chosen().empty()) return chosen();
  std::error_code ignored;
  if (const char* data = std::getenv("PELAGE_DATA"); data != nullptr && *data != '\0') {
    const fs::path folder = fs::absolute(fs::path(data) / "kernels");
    if (!fs::is_directory(folder, ignored))
      throw InputError(fmt::format("PELAGE_DATA is {}: it contains no folder named kernels", data));
    return folder;
  }
  const fs::path folder = data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR).back() / "kernels";
  if (fs::is_directory(folder, ignored)) return folder;
  throw InputError(
      fmt::format("{}: this folder of kernels is missing: name the folder with --kernels or PELAGE_DATA",
                  folder.string()));
}

}  // namespace pelage::cl
