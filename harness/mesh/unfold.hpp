// UV maps, one chart each.
#pragma once
#include <functional>
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

/// Cuts a surface as planned and lays it flat. Throws InputError where that fails.
using Unfold = std::function<Surface(const Surface& surface, const CutPlan& plan, const std::string& name)>;

/// For the named models, whose bits stay: as rigidly as possible by CGAL (Liu et al. 2008, lambda 1000, 10
/// iterations); where that fails, by mean-value coordinates on a circle.
Surface unfold(const Surface& surface, const CutPlan& plan, const std::string& name);

/// For files, of any size: flatten(). `part` is told the fraction that is done.
Surface unfold_large(const Surface& surface, const CutPlan& plan, const std::string& name,
                     const std::function<void(double)>& part = {});

/// Chooses plans by trying: limbs are cut into one after another, farthest first, and a cut stays when the
/// map gets better by it (less squeezed and stretched, without overlapping itself). Dozens of maps are made,
/// so `proxy` should be a coarse version (some 6000 faces) of the surface that is meant: a plan holds points,
/// which carry over. One plan for a surface without handles; several where the cut depends on where it is
/// grown from. `part` is told the fraction that is done.
struct TriedPlan {
  CutPlan plan;
  double cost = 0;  ///< of the proxy's map; less is better
};
std::vector<TriedPlan> plan_cuts(const Surface& proxy, const std::string& name, const Unfold& unfold,
                                 const std::function<void(double)>& part = {});

/// The best of the maps that the plans give.
Surface unfold_best(const Surface& surface, const std::vector<TriedPlan>& plans, const std::string& name);

/// The map of the plan whose proxy's map is best; where that plan fails, of the next. Makes one map.
Surface unfold_first(const Surface& surface, std::vector<TriedPlan> plans, const std::string& name,
                     const Unfold& unfold);

/// Throws InputError where nothing of the surface is cut, so that it cannot lie flat.
void need_cut(const Surface& surface, const Disk& disk, const std::string& name);

}  // namespace pelage
