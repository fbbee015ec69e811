// The mesh while it is being prepared: welded points, triangles, and a UV per corner once there is one.
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
  std::vector<Corners> uv;         ///< per triangle; empty: none yet
  bool periodic_uv = false;        ///< see Mesh::periodic_uv; such a map is left as it is
  bool keep_uv = false;            ///< a file's own map: left as it is, if it lies within the unit square
  bool packed_uv = false;          ///< charts packed into the unit square: left as they are
  std::vector<std::string> notes;  ///< see Mesh::notes
};

}  // namespace pelage
