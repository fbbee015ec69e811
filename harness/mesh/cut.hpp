// Where to cut a surface so that it can lie flat.
#pragma once
#include <cstdint>

#include "harness/mesh/surface.hpp"

namespace pelage {

/// A surface cut open into one disk: every corner belongs to a copy of its point.
struct Disk {
  std::vector<std::uint32_t> point;         ///< per copy, the surface point
  std::vector<Surface::Triangle> triangle;  ///< copies, in the surface's order
  std::size_t extremities = 0;              ///< paths added to reach into limbs
};

/// Cuts a connected manifold of any genus, closed or not: tree-cotree decomposition (Eppstein 2003) leaves a
/// cut graph whose complement is a disk; shortest paths to the points farthest from the cut open up limbs
/// (Sheffer and Hart 2002, Seamster), at most `most` of them and none nearer than `reach` (a length on the
/// surface).
Disk cut_open(const Surface& surface, std::size_t most, double reach);

}  // namespace pelage
