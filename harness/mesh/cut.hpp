// Where to cut a surface so that it can lie flat.
#pragma once
#include <cstdint>

#include "harness/mesh/surface.hpp"

namespace pelage {

/// A surface cut open into one disk: every corner belongs to a copy of its point.
struct Disk {
  std::vector<std::uint32_t> point;         ///< per copy, the surface point
  std::vector<Surface::Triangle> triangle;  ///< copies, in the surface's order
};

/// How to cut: the cut graph is grown from the face nearest to `root`; then paths reach from it to `tips`, in
/// order.
struct CutPlan {
  glm::dvec3 root{0};
  std::vector<glm::dvec3> tips;
};

/// Cuts a connected manifold of any genus, closed or not: tree-cotree decomposition (Eppstein 2003) leaves a
/// cut graph whose complement is a disk; shortest paths open up limbs (Sheffer and Hart 2002, Seamster).
Disk cut_open(const Surface& surface, const CutPlan& plan);

/// The point farthest along the surface from the cut that `plan` makes and from the points of `avoid`, and
/// how far it is.
struct Tip {
  glm::dvec3 point{0};
  double distance = 0;
};
Tip farthest_from_cut(const Surface& surface, const CutPlan& plan, const std::vector<glm::dvec3>& avoid);

}  // namespace pelage
