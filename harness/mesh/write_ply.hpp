// A prepared mesh as a file for other programs.
#pragma once
#include <filesystem>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// Binary little-endian PLY: vertex x y z s t (floats; s and t the UV, by the names that Blender and MeshLab
/// read), face vertex_indices. The file appears whole or not at all. Throws InputError when it cannot be
/// written.
void write_ply(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace pelage
