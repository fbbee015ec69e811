// A disk of triangles laid flat, for meshes of any size.
#pragma once
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "harness/mesh/cut.hpp"
#include "harness/mesh/surface.hpp"

namespace pelage {

struct FlatDisk {
  std::vector<glm::dvec2> uv;  ///< per copy of the disk
  std::size_t flipped = 0;     ///< faces turned over
  bool rigid = false;          ///< as rigid as possible; else harmonic on a circle, which never turns a face
};

/// Lays the disk flat as rigidly as possible (Liu et al. 2008, 10 iterations), from a harmonic map on a
/// circle; time and memory grow with the number of triangles. `part` is told the fraction that is done.
/// Throws InputError where no map of an area comes out.
FlatDisk flatten(const Surface& surface, const Disk& disk, const std::string& name,
                 const std::function<void(double)>& part);

}  // namespace pelage
