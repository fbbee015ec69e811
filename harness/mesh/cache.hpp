// A cache on disk for prepared meshes.
#pragma once
#include <filesystem>
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

/// Reads a mesh from the cache. Returns nothing if the file is missing or damaged.
std::optional<Mesh> read_cached(const std::filesystem::path& file);
/// Writes a mesh to the cache. Returns false if the file cannot be written; the next run then prepares the
/// mesh again.
bool write_cached(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace pelage
