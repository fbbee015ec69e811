// A UV map of one chart.
#pragma once
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "harness/mesh/cut.hpp"

namespace pelage {

/// How a map of one chart came out.
struct MapQuality {
  std::size_t flipped = 0;  ///< faces turned over or without area
  bool usable = false;      ///< finite, of some area, at most 2% of the faces flipped
};
/// uv: per copy; triangles: of copies, turning to the left where they are not flipped.
MapQuality map_quality(const std::vector<glm::dvec2>& uv, const std::vector<Surface::Triangle>& triangles);

/// Cuts the surface into a disk as planned and lays it flat as rigidly as possible (Liu et al. 2008, lambda
/// 1000, 10 iterations); where that fails, by mean-value coordinates on a circle. Throws InputError where
/// that fails too.
Surface unfold(const Surface& surface, const CutPlan& plan, const std::string& name);

/// Chooses plans by trying: limbs are cut into one after another, farthest first, and a cut stays when the
/// map gets better by it (less squeezed and stretched, without overlapping itself). Dozens of maps are made,
/// so `proxy` should be a coarse version (some 6000 faces) of the surface that is meant: a plan holds points,
/// which carry over. One plan for a surface without handles; several where the cut depends on where it is
/// grown from.
std::vector<CutPlan> plan_cuts(const Surface& proxy, const std::string& name);

/// The best of the maps that the plans give.
Surface unfold_best(const Surface& surface, const std::vector<CutPlan>& plans, const std::string& name);

}  // namespace pelage
