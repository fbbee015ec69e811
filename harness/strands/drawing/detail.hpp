// Level of detail of pictures of strands (docs/strands.md, section Level of detail): the strands that are
// drawn, and the number of segments of a strand.
#pragma once
#include <cstddef>
#include <vector>

#include "harness/strands/drawing/drawing.hpp"

namespace pelage::strands {

/// The strands of a picture that draws only a part of the strands. Strand i is drawn if i < `drawn`. Its
/// width is multiplied by widen * min((drawn - i) * per_fade, 1), so the last drawn strands are thinner.
struct Pruning {
  int drawn = 0;
  float widen = 1;     ///< the sum of the factors of all drawn strands is the number of all strands
  float per_fade = 1;  ///< 1 / number of strands that are thinner; 1: no strand is thinner
};

/// Returns the pruning for a fraction above 0 and at most 1 of `strands` strands, at least one strand.
Pruning pruning_of(std::size_t strands, float fraction);

/// Returns a number of segments, at most `most`, for strands of the length `length` (R) whose view depth is
/// at least range.nearest. If such a strand lies parallel to the picture, and if its two segments are equally
/// long and orthogonal, the segments of its strip are not further than 1/4 pixel from its curve. The result
/// is at least 3, because fewer segments would change the mean of a strand's alpha, which falls along the
/// strand as 1 - t^3. `length` is above 0; `most` is 1 to 7.
int segments_on_screen(const Camera& camera, const DepthRange& range, float length, int most);

}  // namespace pelage::strands
