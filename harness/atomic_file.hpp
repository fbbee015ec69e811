// Files that are whole or absent: written beside their place and renamed into it.
#pragma once
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "harness/error.hpp"

namespace pelage {

/// Throws InputError when no file can be at `path`: its folder does not exist, or it is a folder itself.
inline void require_place(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw InputError(path.string() + ": cannot be written, there is no folder '" + folder.string() + "'");
  }
  if (fs::is_directory(path, error)) throw InputError(path.string() + ": cannot be written, it is a folder");
}

/// Calls write(temporary path), then renames that file to `path`. The temporary lies in the same folder and
/// keeps the extension, for libraries that choose a format by it. When `write` throws, nothing is left and
/// `path` is as it was. Throws InputError when the folder does not exist or `path` is a folder.
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
