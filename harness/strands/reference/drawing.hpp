// The double-precision reference for pictures of strands (docs/strands.md, section Drawing). It draws one
// strand at a time, visits every pixel near each segment, and sorts with std::stable_sort. It shares no code
// with the kernels.
#pragma once
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/strands/drawing/drawing.hpp"

namespace pelage::strands::reference {

/// Returns the strands to draw, from front to back. The list contains no strands that face away from the
/// camera, none that are nearer than the near plane and none that are beyond a side of the picture. Its
/// operations are those of docs/strands.md in single
/// precision, so that a device must give the same list.
std::vector<Entry> drawing_order(const Camera& camera, const DepthRange& range,
                                 const std::vector<DrawnStrand>& strands);

/// Draws the strands of `order`, which is a result of drawing_order(). Alpha of a pixel is the coverage of
/// the strands. The values in `look` must be in their valid ranges.
Picture draw(const Camera& camera, const Look& look, const std::vector<DrawnStrand>& strands,
             const std::vector<Entry>& order);

}  // namespace pelage::strands::reference
