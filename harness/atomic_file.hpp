// Atomic writing of files: a file is written under a temporary name and then renamed, so that an incomplete
// file never has the final name.
#pragma once
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "harness/error.hpp"

namespace pelage {

/// Throws InputError if no file can be written to `path`, because its folder does not exist or because `path`
/// is a folder.
inline void require_place(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw InputError(path.string() + ": cannot be written, because the folder '" + folder.string() +
                     "' does not exist");
  }
  if (fs::is_directory(path, error))
    throw InputError(path.string() + ": cannot be written, because it is a folder");
}

/// Calls write(temporary path), then renames the written file to `path`. The temporary file is in the same
/// folder and has the same extension, because some libraries choose the format by the extension. If `write`
/// throws, the temporary file is removed and `path` is unchanged. Throws InputError if the folder does not
/// exist, if `path` is a folder, or if renaming fails.
template <class Write>
void write_atomically(const std::filesystem::path& path, Write&& write) {
  namespace fs = std::filesystem;
  require_place(path);
  std::string name = ".";
  name += path.stem().string();
  name += '.';
  name += std::to_string(getpid());
  name += path.extension().string();
  const fs::path temporary = path.parent_path() / name;
  std::error_code error;
  try {
    std::forward<Write>(write)(temporary);
    fs::rename(temporary, path);
  } catch (const fs::filesystem_error& failure) {
    fs::remove(temporary, error);
    throw InputError(path.string() + ": cannot be written: " + failure.code().message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

}  // namespace pelage
