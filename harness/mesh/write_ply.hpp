// Writes a prepared mesh to a file for other programs.
#pragma once
#include <filesystem>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// Writes binary little-endian PLY. A vertex has the floats x y z s t; s and t are the UV; Blender and
/// MeshLab read the UV under these names. A face has vertex_indices. The file is written under a temporary
/// name and renamed. Throws InputError if it cannot be written.
void write_ply(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace pelage
