// The files of the cache of prepared meshes.
#pragma once
#include <optional>

#include "harness/mesh/disk_cache.hpp"
#include "harness/mesh/mesh.hpp"

namespace pelage {

/// The text with which every cache file begins. It contains the version of the format.
inline constexpr std::string_view mesh_cache_title = "pelage mesh 1\n";

std::string encode(const Mesh& mesh);
/// Decodes the result of encode(). Returns nothing if the bytes are incomplete or damaged, or do not begin
/// with mesh_cache_title.
std::optional<Mesh> decode(std::string_view bytes);

}  // namespace pelage
