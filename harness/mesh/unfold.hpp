// Cuts a surface open, flattens it and gives its UV map.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

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
  glm::dvec3 point;
  double distance;
};
/// Returns the surface point that is farthest from the cuts of `plan`, from plan.tips and from the points of
/// `avoid`. The distance is the length of the shortest path along the edges.
Tip farthest_from_cut(const Surface& surface, const CutPlan& plan, const std::vector<glm::dvec3>& avoid);

// Flattens a topological disk of triangles in a time that grows linearly with the number of triangles.

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

// Computes UV maps that consist of one chart.

/// Quality of a UV map of one chart.
struct MapQuality {
  std::size_t flipped = 0;  ///< number of faces that are flipped or have zero area
  /// True: the map is finite, has a positive area, and at most 2% of its faces are flipped.
  bool usable = false;
};
/// Measures a UV map. `uv` has one entry per vertex of a Disk. A surface point on a cut corresponds to
/// several vertices of the disk. For each triangle, `triangles` contains three indices into `uv`. A face is
/// flipped unless its corners are counter-clockwise in UV.
MapQuality map_quality(const std::vector<glm::dvec2>& uv, const std::vector<Surface::Triangle>& triangles);

/// A function that cuts a surface open according to `plan` and flattens it. Throws InputError if this fails.
using Unfold = std::function<Surface(const Surface& surface, const CutPlan& plan, const std::string& name)>;

/// Computes the UV map of a named model by CGAL. The map is as rigid as possible (Liu et al. 2008, lambda
/// 1000, 10 iterations). If this map is not usable, CGAL computes mean-value coordinates on a circle instead.
/// Named models keep these methods so that their meshes stay bitwise identical in later versions of pelage.
Surface unfold_model(const Surface& surface, const CutPlan& plan, const std::string& name);

/// Computes the UV map of a mesh file by flatten(), which is suitable for large meshes. During the
/// computation, `part` is called with the completed fraction of the work, 0 to 1.
Surface unfold_file(const Surface& surface, const CutPlan& plan, const std::string& name,
                    const std::function<void(double)>& part = {});

/// A cut plan and the cost of its UV map.
struct TriedPlan {
  CutPlan plan;
  double cost;  ///< cost of the UV map of a coarse version of the surface; a lower cost is better
};
/// Chooses cut plans by trial. The function tries cuts to the ends of the model's limbs (CutPlan::tips) one
/// after another; each cut leads to the point farthest from the earlier cuts and from the ends tried before.
/// The function keeps a cut if the cut lowers the cost of the UV map. The cost measures stretch, overlap and
/// flipped faces. Dozens of maps are computed, so `proxy` should be a coarse version of the surface (about
/// 6000 faces). A plan consists of 3D points and not of vertex indices, so it can also be applied to the fine
/// surface. Returns one plan for a surface without handles, otherwise four plans that start at different
/// points (CutPlan::root). During the computation, `part` is called with the completed fraction of the work,
/// 0 to 1.
std::vector<TriedPlan> plan_cuts(const Surface& proxy, const std::string& name, const Unfold& unfold,
                                 const std::function<void(double)>& part = {});

/// Computes the UV map of every plan and returns the surface with the map of the lowest cost.
Surface unfold_best(const Surface& surface, const std::vector<TriedPlan>& plans, const std::string& name);

/// Tries the cut plans in the order of increasing cost until `unfold` computes a UV map without throwing
/// InputError. Returns the surface with this map.
Surface unfold_first(const Surface& surface, std::vector<TriedPlan> plans, const std::string& name,
                     const Unfold& unfold);

/// Returns the surface with the map of the disk's vertices. `method` and `flipped` stand in the notes.
Surface with_map(const Surface& surface, const CutPlan& plan, const Disk& disk,
                 const std::vector<glm::dvec2>& uv, const std::string& method, std::size_t flipped);

/// Throws InputError if `disk`, cut from `surface`, is closed: it cannot be flattened.
void need_cut(const Surface& surface, const Disk& disk, const std::string& name);

}  // namespace pelage
