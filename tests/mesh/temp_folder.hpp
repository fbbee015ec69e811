#pragma once
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "harness/mesh/mesh.hpp"
#include "tests/support/files.hpp"

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
struct TempFolder : test::Folder {
  std::string write(const std::string& name, const std::string& bytes) const {
    test::write_text(path / name, bytes);
    return (path / name).string();
  }
};

}  // namespace pelage
