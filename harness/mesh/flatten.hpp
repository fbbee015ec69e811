// Flattens a topological disk of triangles in a time that grows linearly with the number of triangles.
#pragma once
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "harness/mesh/cut.hpp"
#include "harness/mesh/surface.hpp"

namespace pelage {

struct FlatDisk {
  /// UV of each vertex of the cut-open disk. A surface point on a cut has several vertices.
  std::vector<glm::dvec2> uv;
  std::size_t flipped = 0;  ///< number of flipped faces
  bool rigid = false;  ///< true: the map is as rigid as possible; false: it is the harmonic map onto a circle
};

constexpr int most_rigid = 10;  ///< default number of iterations of flatten()

/// Flattens the disk as rigidly as possible (Liu et al. 2008). The initial map is the harmonic map onto a
/// circle, which has no overlaps and is also the result if `iterations` is 0 or if the iterations fail. Each
/// iteration reduces the distortion, but overlaps and flipped faces may appear. Time and memory grow linearly
/// with the number of triangles. `part` receives the completed fraction, 0 to 1. Throws InputError if no
/// usable map is found.
FlatDisk flatten(const Surface& surface, const Disk& disk, const std::string& name,
                 const std::function<void(double)>& part, int iterations = most_rigid);

}  // namespace pelage
