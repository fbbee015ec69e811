// Prepared meshes on disk.
#pragma once
#include <filesystem>
#include <optional>

#include "harness/mesh/disk_cache.hpp"
#include "harness/mesh/mesh.hpp"

namespace pelage {

std::string encode(const Mesh& mesh);
/// Empty when the bytes are not exactly what encode() once gave: torn, damaged or of another version.
std::optional<Mesh> decode(std::string_view bytes);

/// The mesh in `file`; empty when there is none or it is damaged.
std::optional<Mesh> read_cached(const std::filesystem::path& file);
/// False when that was not possible: the mesh is still good, only slower the next time.
bool write_cached(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace pelage
