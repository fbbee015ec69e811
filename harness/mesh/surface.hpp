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
  bool keep_uv = false;      ///< true: the file's map; finish() changes it only if it exceeds the unit square
  bool packed_uv = false;    ///< true: charts packed into the unit square; finish() does not change the map
  std::vector<std::string> notes;  ///< see Mesh::notes
};

}  // namespace pelage
