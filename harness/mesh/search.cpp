#include "harness/mesh/search.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <glm/geometric.hpp>

namespace pelage {
namespace {

using Cartesian = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Cartesian::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Cartesian, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Cartesian, Primitive>>;

Cartesian::Point_3 point(glm::vec3 p) {
  return {double(p.x), double(p.y), double(p.z)};
}

}  // namespace

struct SurfaceSearch::State {
  std::shared_ptr<const Mesh> mesh;
  Triangles triangles;
  Tree tree;

  SurfacePlace place(Triangles::const_iterator at, const Cartesian::Point_3& q) const {
    SurfacePlace place;
    place.triangle = std::uint32_t(at - triangles.begin());
    const glm::uvec3 t = mesh->triangle[place.triangle];
    const glm::dvec3 a(mesh->position[t.x]), b(mesh->position[t.y]), c(mesh->position[t.z]),
        p(q.x(), q.y(), q.z());
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double area = glm::dot(n, n);
    glm::dvec3 weight(1, 0, 0);
    if (area > 0) {
      weight.y = glm::dot(glm::cross(p - a, c - a), n) / area;
      weight.z = glm::dot(glm::cross(b - a, p - a), n) / area;
      weight.x = 1 - weight.y - weight.z;
    }
    place.weight = glm::vec3(weight);
    place.point = glm::vec3(p);
    place.uv = glm::vec2(weight.x * glm::dvec2(mesh->uv[t.x]) + weight.y * glm::dvec2(mesh->uv[t.y]) +
                         weight.z * glm::dvec2(mesh->uv[t.z]));
    return place;
  }
};

SurfaceSearch::SurfaceSearch(std::shared_ptr<const Mesh> mesh) : state_(std::make_shared<State>()) {
  state_->mesh = std::move(mesh);
  for (const glm::uvec3& t : state_->mesh->triangle) {
    const auto& position = state_->mesh->position;
    state_->triangles.emplace_back(point(position[t.x]), point(position[t.y]), point(position[t.z]));
  }
  state_->tree.rebuild(state_->triangles.begin(), state_->triangles.end());
  // Without this call, the first distance query would build a second search tree. If two threads made the
  // first query at the same time, both would build this tree.
  state_->tree.accelerate_distance_queries();
}

SurfacePlace SurfaceSearch::closest(glm::vec3 to) const {
  const auto [q, triangle] = state_->tree.closest_point_and_primitive(point(to));
  return state_->place(triangle, q);
}

std::optional<SurfacePlace> SurfaceSearch::ray(glm::vec3 origin, glm::vec3 direction) const {
  const Cartesian::Ray_3 ray(
      point(origin), Cartesian::Vector_3(double(direction.x), double(direction.y), double(direction.z)));
  const auto hit = state_->tree.first_intersection(ray);
  if (!hit) return {};
  // The intersection is a segment if the ray lies in the plane of the triangle; the ray enters the triangle
  // at the source of the segment.
  if (const auto* q = boost::get<Cartesian::Point_3>(&hit->first)) return state_->place(hit->second, *q);
  return state_->place(hit->second, boost::get<Cartesian::Segment_3>(&hit->first)->source());
}

}  // namespace pelage
