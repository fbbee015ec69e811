// Which triangles of the base surface face away from the eye (docs/frame.md, section 5).
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::rivals {

/// The places in `index` (3 per triangle, in the order of the mesh) of the triangles, sorted by facing. Both
/// lists keep the mesh's order.
struct Facing {
  std::vector<std::uint32_t> away, towards;  ///< elements of `index`, three per triangle
};

/// Splits `index` by the facing of each triangle's base. The signed area of the screen positions, rounded to
/// 1/256 pixel, decides. A triangle that crosses the near plane or the guard band is not rounded.
Facing facing(const Camera& camera, const Mesh& mesh, const std::vector<std::uint32_t>& index);

}  // namespace pelage::rivals
