#include "harness/mesh/unfold.hpp"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Mean_value_coordinates_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "harness/error.hpp"
#include "harness/mesh/cgal_mesh.hpp"
#include "harness/mesh/finish.hpp"

namespace SMP = CGAL::Surface_mesh_parameterization;

namespace pelage {
namespace {

using Lu = CGAL::Eigen_solver_traits<
    Eigen::SparseLU<CGAL::Eigen_sparse_matrix<double>::EigenType, Eigen::COLAMDOrdering<int>>>;

// A linear solver that factorizes its matrix once. CGAL's ARAP parameterizer (as rigid as possible) solves
// two systems with the same matrix in each iteration.
class Factored_once {
 public:
  using NT = double;
  using Matrix = Lu::Matrix;
  using Vector = Lu::Vector;
  bool linear_solver(const Matrix& a, const Vector& b, Vector& x, NT& scale) {
    scale = 1;
    if (!solver_) {
      solver_ = std::make_shared<Solver>();
      solver_->compute(a.eigen_object());
    }
    const bool factored = solver_->info() == Eigen::Success;
    if (factored) x = solver_->solve(b);
    return factored;
  }

 private:
  using Solver = Eigen::SparseLU<Matrix::EigenType, Eigen::COLAMDOrdering<int>>;
  std::shared_ptr<Solver> solver_;
};

using Point2 = Kernel::Point_2;
using Border = SMP::Circular_border_arc_length_parameterizer_3<Polyhedron>;
using Rigid = SMP::ARAP_parameterizer_3<Polyhedron, Border, Factored_once>;
using Convex = SMP::Mean_value_coordinates_parameterizer_3<Polyhedron, Border, Lu>;

Polyhedron flat_mesh(const Surface& surface, const Disk& disk) {
  const Sphere sphere = bounding_sphere(surface.point);
  Surface opened;
  for (const std::uint32_t p : disk.point)
    opened.point.push_back((surface.point[p] - sphere.centre) / sphere.radius);
  opened.triangle = disk.triangle;
  return to_cgal(opened);
}

// Returns the UV of each vertex of the cut mesh. A point on a cut has several vertices.
template <class Parameterizer>
std::vector<glm::dvec2> lay_flat(Polyhedron& mesh, Parameterizer parameterizer) {
  auto uv = mesh.add_property_map<Polyhedron::Vertex_index, Point2>("v:uv", Point2(CGAL::ORIGIN)).first;
  auto index = mesh.add_property_map<Polyhedron::Vertex_index, int>("v:number").first;
  auto placed = mesh.add_property_map<Polyhedron::Vertex_index, bool>("v:placed").first;
  for (const auto v : mesh.vertices()) index[v] = int(v.idx());
  const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  // The returned error code is ignored. Code 6 (no one-to-one mapping) means that the last step of the ARAP
  // parameterizer rejected a border that intersects itself. The map is complete nevertheless.
  (void)parameterizer.parameterize(mesh, border, uv, index, placed);
  std::vector<glm::dvec2> map;
  for (const auto v : mesh.vertices()) map.emplace_back(uv[v].x(), uv[v].y());
  mesh.remove_property_map(uv);
  mesh.remove_property_map(index);
  mesh.remove_property_map(placed);
  return map;
}

}  // namespace

MapQuality map_quality(const std::vector<glm::dvec2>& uv, const std::vector<Surface::Triangle>& triangles) {
  MapQuality quality;
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    const glm::dvec2 e = uv[b] - uv[a], g = uv[c] - uv[a];
    const double twice = e.x * g.y - e.y * g.x;
    area += twice;
    if (!(twice > 0)) ++quality.flipped;
  }
  quality.usable = std::isfinite(area) && area > 0 && quality.flipped * 50 <= triangles.size();
  return quality;
}

Surface unfold_model(const Surface& surface, const CutPlan& plan, const std::string& name) {
  const Disk disk = cut_open(surface, plan);
  need_cut(surface, disk, name);
  Polyhedron mesh = flat_mesh(surface, disk);
  std::vector<glm::dvec2> map = lay_flat(mesh, Rigid(Border(), Factored_once(), 1000, 10, 1e-6));
  MapQuality quality = map_quality(map, disk.triangle);
  std::string method = "as rigidly as possible";
  if (!quality.usable) {
    map = lay_flat(mesh, Convex());
    quality = map_quality(map, disk.triangle);
    method = "mean-value coordinates on a circle";
  }
  if (!quality.usable) throw InputError(fmt::format("{}: no UV map can be made for this mesh", name));
  return with_map(surface, plan, disk, map, method, quality.flipped);
}

}  // namespace pelage
