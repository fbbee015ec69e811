// The frames of a mesh that moves and deforms: one mesh file per frame.
#pragma once
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// Returns the file of frame `frame`, where `first` is the file of frame 0. The last number in the name of
/// `first` counts up, and keeps its leading zeros: "walk-0009.obj" is followed by "walk-0010.obj". Throws
/// InputError if the name contains no number.
std::filesystem::path frame_file(const std::filesystem::path& first, int frame);

/// Returns the positions of the mesh's surface points (Mesh::weld) in `count` frames, in R. `mesh` is the
/// prepared mesh of the file `first`, rotated by `rotation` (degrees about x, then y, then z). All frames get
/// the rotation, the translation and the scale that the preparation gave to the first frame. Throws
/// InputError if a file is missing or not a mesh, if it has other faces than the first file, if the
/// preparation of the first file moved or added points, or if points that coincide in the first frame part in
/// a later one.
std::vector<std::vector<glm::vec3>> read_mesh_frames(const Mesh& mesh, const std::filesystem::path& first,
                                                     int count, glm::dvec3 rotation);

}  // namespace pelage
