// Cuts a surface open, so that it can be flattened.
#pragma once
#include <cstdint>

#include "harness/mesh/surface.hpp"

namespace pelage {

/// A surface that is cut open into one topological disk. A surface point on the cut has several copies, and
/// every corner of a triangle refers to one copy.
struct Disk {
  std::vector<std::uint32_t> point;         ///< surface point of each copy
  std::vector<Surface::Triangle> triangle;  ///< indices of copies; triangles in the surface's order
};

/// Positions that determine the cuts. The cut graph is grown from the face nearest to `root`. Then a path
/// from the cuts to each of the `tips` is added, in their order.
struct CutPlan {
  glm::dvec3 root{0};
  std::vector<glm::dvec3> tips;
};

/// Cuts a connected manifold of any genus, closed or with borders. A tree-cotree decomposition (Eppstein
/// 2003) gives a cut graph whose complement is a disk. Shortest paths to the tips cut limbs open (Sheffer and
/// Hart 2002, Seamster).
Disk cut_open(const Surface& surface, const CutPlan& plan);

/// The point of greatest distance along the edges of the surface from the cuts of `plan` and from the points
/// of `avoid`, and this distance.
struct Tip {
  glm::dvec3 point{0};
  double distance = 0;
};
Tip farthest_from_cut(const Surface& surface, const CutPlan& plan, const std::vector<glm::dvec3>& avoid);

}  // namespace pelage
