// Writes a prepared mesh to a file for other programs.
#pragma once
#include <filesystem>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// Writes binary little-endian PLY. A vertex has the floats x y z s t. The UV coordinates have the names s
/// and t, because Blender and MeshLab read UV coordinates under these names. A face has vertex_indices. The
/// file is written under a temporary name and renamed. Throws InputError if the file cannot be written.
void write_ply(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace pelage
