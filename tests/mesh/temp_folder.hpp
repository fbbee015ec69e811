#pragma once
#include <optional>

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

}  // namespace pelage
