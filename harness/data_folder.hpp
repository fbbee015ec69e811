// Finds the files that pelage reads at run time: kernels, shaders, experiments, models.toml, readings, and
// the Python programs that draw plots.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

namespace pelage {

/// Returns the folders in which pelage searches for its data, in the order of the search. $PELAGE_DATA is the
/// first folder if this variable is set. The next folder is the data folder of the installation or, if the
/// program is in a build folder, the source tree `source`. `shared` is the path of the data
/// (PREFIX/share/pelage) relative to the folder of the program (PREFIX/bin). It is relative, so that users
/// may move an installation to another prefix. An installed program does not read the source tree.
inline std::vector<std::filesystem::path> data_folders(const std::filesystem::path& source,
                                                       const std::filesystem::path& shared) {
  std::vector<std::filesystem::path> folders;
  if (const char* data = std::getenv("PELAGE_DATA"); data != nullptr && *data != '\0')
    folders.emplace_back(data);
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path installed = (program.parent_path() / shared).lexically_normal();
  folders.push_back(std::filesystem::is_directory(installed / "kernels", ignored) ? installed : source);
  return folders;
}

}  // namespace pelage
