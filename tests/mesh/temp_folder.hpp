#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// Returns options with which load_model() prepares a mesh without the cache.
inline MeshOptions fresh(std::optional<std::uint32_t> faces = {}, bool keep_uv = false) {
  MeshOptions options;
  options.faces = faces;
  options.keep_uv = keep_uv;
  options.cache = false;
  return options;
}

/// A temporary folder; the destructor removes it.
class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pelage-mesh-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace pelage
