// Atomic writing of files: a file is written under a temporary name and then renamed, so that an incomplete
// file never has the final name.
#pragma once
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "harness/error.hpp"

namespace pelage {

/// Returns the folder of temporary files: TMPDIR, or /tmp if TMPDIR is no folder. Throws InputError if /tmp
/// is none either.
inline std::filesystem::path temporary_folder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) return folder;
  if (!std::filesystem::is_directory("/tmp", error))
    throw InputError("TMPDIR and /tmp are no folders; set TMPDIR to a folder for temporary files");
  return "/tmp";
}

/// Throws InputError if the folder that should contain `path` does not exist, or if `path` itself is a
/// folder.
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

/// Copies the bytes of `from` to the device, pipe or socket `to`. Throws InputError if the bytes cannot be
/// written.
inline void copy_bytes(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::ifstream source(from, std::ios::binary);
  std::ofstream target(to, std::ios::binary);
  if (source.peek() != std::ifstream::traits_type::eof()) target << source.rdbuf();
  target.flush();
  if (!target) throw InputError(to.string() + ": cannot be written: " + std::strerror(errno));
}

/// Calls write(temporary path), then renames the temporary file to `path`. The temporary file is in the
/// folder of `path`. It has the extension of `path`, because some libraries derive the file format
/// from the extension. If `path` is a symbolic link, the function writes the file that the link points to,
/// which need not exist. If `path` exists and is not a regular file, for example a device or a pipe, the
/// temporary file is in the system's temporary folder, and the function copies the bytes of the temporary
/// file to `path`. If `write` throws, the temporary file is removed and `path` is unchanged. Throws
/// InputError if the folder of `path` does not exist, if `path` is a folder or a symbolic link that leads
/// back to itself, or if renaming or copying fails.
template <class Write>
void write_atomically(const std::filesystem::path& path, Write&& write) {
  namespace fs = std::filesystem;
  require_place(path);
  std::error_code error;
  fs::path target = path;
  for (int links = 0; fs::is_symlink(fs::symlink_status(target, error)); ++links) {
    if (links == 40) throw InputError(path.string() + ": cannot be written: its symbolic links form a loop");
    const fs::path to = fs::read_symlink(target, error);
    if (error) throw InputError(path.string() + ": cannot be written: " + error.message());
    target = target.parent_path() / to;  // `to` itself if it is absolute
    require_place(target);
  }
  const bool special = fs::exists(target, error) && !fs::is_regular_file(target, error);
  std::string name = ".";
  name += target.stem().string();
  name += '.';
  name += std::to_string(getpid());
  name += target.extension().string();
  const fs::path temporary = (special ? temporary_folder() : target.parent_path()) / name;
  try {
    std::forward<Write>(write)(temporary);
    if (special) {
      copy_bytes(temporary, target);
      fs::remove(temporary, error);
    } else {
      fs::rename(temporary, target);
    }
  } catch (const fs::filesystem_error& failure) {
    fs::remove(temporary, error);
    throw InputError(path.string() + ": cannot be written: " + failure.code().message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

/// Writes the text to the file `path` with write_atomically(). Throws InputError if the text cannot be
/// written, for example because the disk is full.
inline void write_text_atomically(const std::filesystem::path& path, const std::string& text) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text << std::flush;
    if (!stream) throw InputError(path.string() + ": cannot be written: " + std::strerror(errno));
  });
}

}  // namespace pelage
