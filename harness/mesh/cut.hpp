// Cuts a surface open, so that it can be flattened.
#pragma once
#include <cstdint>

#include "harness/mesh/surface.hpp"

namespace pelage {

/// A surface that is cut open into one topological disk. A surface point on the cut becomes several
/// vertices of the disk.
struct Disk {
  std::vector<std::uint32_t> point;  ///< per vertex of the disk, the index of its surface point
  /// For each triangle of the surface, the indices of the three vertices of the disk at its corners.
  std::vector<Surface::Triangle> triangle;
};

/// Positions that determine the cuts. The computation of the cut graph starts at the face nearest to `root`.
/// Then, for one point of `tips` after another, the shortest path from the existing cuts to this point
/// becomes a further cut.
struct CutPlan {
  glm::dvec3 root{0};
  std::vector<glm::dvec3> tips;
};

/// Cuts a connected manifold of any genus, closed or with borders. A tree-cotree decomposition (Eppstein
/// 2003) gives a cut graph whose complement is a disk. Shortest paths from the cut graph to the points of
/// plan.tips become further cuts, as in the method Seamster (Sheffer and Hart 2002). Cuts to the ends of
/// limbs reduce the distortion of the limbs in the UV map.
Disk cut_open(const Surface& surface, const CutPlan& plan);

/// The result of farthest_from_cut(): a surface point, and its distance from the cuts.
struct Tip {
  glm::dvec3 point{0};
  double distance = 0;
};
/// Returns the surface point that is farthest from the cuts of `plan`, from plan.tips and from the points of
/// `avoid`. The distance is the length of the shortest path along the edges.
Tip farthest_from_cut(const Surface& surface, const CutPlan& plan, const std::vector<glm::dvec3>& avoid);

}  // namespace pelage
