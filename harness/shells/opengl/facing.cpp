#include "harness/shells/opengl/facing.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace pelage::rivals {
namespace {

/// A base vertex: homogeneous position in pixels from the image centre, and the rounded position in 1/256
/// pixel.
struct Placed {
  glm::vec3 homogeneous;
  std::int32_t x = 0, y = 0;
  bool inside = false;  ///< beyond the near plane and within the guard band
};

constexpr float guard = 16384;

Placed placed(const Camera& camera, const glm::vec3& p) {
  // The same operations as in kernels/rasterize/geometry/transform.clh, so that both round equally.
  const auto affine = [&](const glm::vec4& row) {
    return std::fma(row.x, p.x, std::fma(row.y, p.y, std::fma(row.z, p.z, row.w)));
  };
  Placed v;
  v.homogeneous = {affine(camera.row_x), affine(camera.row_y), affine(camera.row_w)};
  const float w = v.homogeneous.z, reach = guard * w;
  v.inside = w >= camera.near && std::abs(v.homogeneous.x) <= reach && std::abs(v.homogeneous.y) <= reach;
  if (!v.inside) return v;
  const float inverse = 1 / w;
  v.x = std::int32_t(std::rint(v.homogeneous.x * inverse * 256.0f));
  v.y = std::int32_t(std::rint(v.homogeneous.y * inverse * 256.0f));
  return v;
}

bool faces_away(const Placed& a, const Placed& b, const Placed& c) {
  if (a.inside && b.inside && c.inside)
    return std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(c.x - a.x) * (b.y - a.y) > 0;
  return glm::determinant(glm::dmat3(a.homogeneous, b.homogeneous, c.homogeneous)) > 0;
}

}  // namespace

Facing facing(const Camera& camera, const Mesh& mesh) {
  std::vector<Placed> place;
  place.reserve(mesh.position.size());
  for (const glm::vec3& p : mesh.position) place.push_back(placed(camera, p));
  Facing found;
  for (std::size_t f = 0; f < mesh.triangle.size(); ++f) {
    const glm::uvec3& t = mesh.triangle[f];
    (faces_away(place[t.x], place[t.y], place[t.z]) ? found.away : found.towards).push_back(std::uint32_t(f));
  }
  return found;
}

std::vector<std::uint32_t> elements_of(const std::vector<std::uint32_t>& list,
                                       const std::vector<std::uint32_t>& index) {
  std::vector<std::uint32_t> elements;
  elements.reserve(3 * list.size());
  for (const std::uint32_t f : list)
    for (std::size_t corner = 0; corner < 3; ++corner) elements.push_back(index[3 * std::size_t(f) + corner]);
  return elements;
}

}  // namespace pelage::rivals
