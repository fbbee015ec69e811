// Which triangles of the base surface face away from the eye (docs/shells.md, section 5).
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::rivals {

/// The numbers of the triangles whose base faces away from the eye and towards it. Both lists keep the mesh's
/// order.
struct Facing {
  std::vector<std::uint32_t> away, towards;
};

/// Returns the facing of each triangle's base. The signed area of the screen positions, rounded to 1/256
/// pixel, decides. A triangle that crosses the near plane or the guard band is not rounded.
Facing facing(const Camera& camera, const Mesh& mesh);

/// Returns the elements of `index`, which has three per triangle, of the triangles in `list`.
std::vector<std::uint32_t> elements_of(const std::vector<std::uint32_t>& list,
                                       const std::vector<std::uint32_t>& index);

}  // namespace pelage::rivals
