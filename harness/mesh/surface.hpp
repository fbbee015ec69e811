// The mesh during its preparation: welded points, triangles, and a UV per corner after the UV map is
// computed.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace pelage {

struct Surface {
  using Triangle = std::array<std::uint32_t, 3>;
  using Corners = std::array<glm::dvec2, 3>;
  std::vector<glm::dvec3> point;
  std::vector<Triangle> triangle;
  std::vector<Corners> uv;   ///< UV of the three corners of each triangle; empty if there is no UV map
  bool periodic_uv = false;  ///< see Mesh::periodic_uv; finish() does not change a periodic map
  /// True if the UV map comes from the file. finish() changes this map only if it exceeds the unit square.
  bool keep_uv = false;
  /// True if the charts are packed into the unit square. finish() does not change a packed map.
  bool packed_uv = false;
  std::vector<std::string> notes;  ///< see Mesh::notes
};

/// Returns twice the signed area of a triangle in UV. It is negative if the triangle is flipped (clockwise).
inline double twice_uv_area(const Surface::Corners& uv) {
  const glm::dvec2 d = uv[1] - uv[0], e = uv[2] - uv[0];
  return d.x * e.y - d.y * e.x;
}

}  // namespace pelage
