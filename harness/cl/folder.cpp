// Searches for the folder of kernel sources.
#include <fmt/format.h>

#include <cstdlib>

#include "harness/cl/program.hpp"
#include "harness/error.hpp"

namespace pelage::cl {
namespace fs = std::filesystem;
namespace {

// The folder given by --kernels, for the whole process; empty without the option.
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
  const fs::path source = fs::path(PELAGE_SOURCE_DIR) / "kernels";
  if (fs::is_directory(source, ignored)) return source;
  // Installed files: <prefix>/bin/pelage uses <prefix>/share/pelage/kernels.
  const fs::path binary = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path shared = binary.parent_path().parent_path() / "share" / "pelage" / "kernels";
  if (fs::is_directory(shared, ignored)) return shared;
  throw InputError(fmt::format("no kernels in {} or {}: name the folder with --kernels or PELAGE_DATA",
                               source.string(), shared.string()));
}

}  // namespace pelage::cl
