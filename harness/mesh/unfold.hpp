// Computes UV maps of one chart.
#pragma once
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "harness/mesh/cut.hpp"

namespace pelage {

/// Quality of a map of one chart.
struct MapQuality {
  std::size_t flipped = 0;  ///< number of faces that are flipped or have zero area
  bool usable = false;      ///< true: finite, of positive area, at most 2% of the faces flipped
};
/// `uv` has one entry per copy; `triangles` are indices of copies. Faces that are not flipped are
/// counter-clockwise.
MapQuality map_quality(const std::vector<glm::dvec2>& uv, const std::vector<Surface::Triangle>& triangles);

/// A function that cuts a surface by a plan and flattens it. Throws InputError if this fails.
using Unfold = std::function<Surface(const Surface& surface, const CutPlan& plan, const std::string& name)>;

/// The map of named models: as rigid as possible by CGAL (Liu et al. 2008, lambda 1000, 10 iterations), or
/// mean-value coordinates on a circle if that fails. Named models keep this method so that their bits do not
/// change.
Surface unfold(const Surface& surface, const CutPlan& plan, const std::string& name);

/// The map of files, by flatten(), which suits large meshes. `part` receives the completed fraction.
Surface unfold_large(const Surface& surface, const CutPlan& plan, const std::string& name,
                     const std::function<void(double)>& part = {});

/// Chooses cut plans by trials. Cuts into limbs are added one after another, the farthest tip first. A cut is
/// kept if it lowers the map's cost, a measure of stretch, overlap and flipped faces. Dozens of maps are
/// computed, so `proxy` should be a coarse version of the surface (about 6000 faces). A plan consists of
/// positions and therefore also applies to the fine surface. Returns one plan for a surface without handles,
/// four plans with different roots otherwise. `part` receives the completed fraction.
struct TriedPlan {
  CutPlan plan;
  double cost = 0;  ///< cost of the proxy's map; less is better
};
std::vector<TriedPlan> plan_cuts(const Surface& proxy, const std::string& name, const Unfold& unfold,
                                 const std::function<void(double)>& part = {});

/// Computes the map of every plan and returns the best one.
Surface unfold_best(const Surface& surface, const std::vector<TriedPlan>& plans, const std::string& name);

/// Returns the map of the plan of least cost. If this plan fails, the next one is tried.
Surface unfold_first(const Surface& surface, std::vector<TriedPlan> plans, const std::string& name,
                     const Unfold& unfold);

/// Throws InputError if `disk` is a closed surface without cuts, which cannot be flattened.
void need_cut(const Surface& surface, const Disk& disk, const std::string& name);

}  // namespace pelage
