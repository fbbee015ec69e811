// Level of detail of pictures of strands (docs/strands.md, section "Level of detail"): the strands that are
// drawn, and the number of segments of a strand.
#pragma once
#include <cstddef>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands {

/// The strands of a picture that draws only a part of the strands. Strand i is drawn if i < `drawn`. Its
/// width is multiplied by widen * min((drawn - i) * per_fade, 1), so the last drawn strands are thinner.
struct Pruning {
  int drawn = 0;
  /// The sum of the factors of all drawn strands is Look::width_factor times the number of all strands.
  float widen = 1;
  float per_fade = 1;  ///< 1 / number of strands that are thinner; 1: no strand is thinner
};

/// Returns the pruning of `strands` strands for the look's fraction and width factor. At least one strand is
/// drawn.
Pruning pruning_of(std::size_t strands, const Look& look);

/// Values of a fur from which overlap_factor() computes how much its strands overlap.
struct Spread {
  std::size_t strands = 0;  ///< number of all strands
  float width = 0;          ///< mean width of the strands at their roots, R
  float area = 0;           ///< area of the surface, R^2
};

/// Returns the spread of the strands, which are on the surface of `mesh`.
Spread spread_of(const std::vector<KeyedStrand>& strands, const Mesh& mesh);

/// Returns the factor of all widths with which a picture of a part of the strands has nearly the same mean
/// coverage as a picture of all strands (docs/strands.md, section "Level of detail"): 1 if look.fraction is
/// 1, otherwise less, because the roots are blue noise, so that few wide strands overlap less than many thin
/// strands. Also 1 if there is no surface (spread.area is 0). The function does not use look.width_factor.
float overlap_factor(const Camera& camera, const Look& look, const Spread& spread);

/// Returns the part of the strands that is drawn if their mean width at the roots must be at least
/// `least_width` pixels at the view depth of the object's origin: the mean width in pixels divided by
/// `least_width`, but at least 0.001 and at most 1. If `least_width` is 0, the result is 1.
float fraction_on_screen(const Camera& camera, const Spread& spread, float least_width);

/// Returns a number of segments, at most `most`, for strands of the length `length` (R) whose view depth is
/// at least range.nearest. If such a strand lies parallel to the picture, and if its two segments are equally
/// long and orthogonal, the segments of its strip are not further than 1/4 pixel from its curve. The result
/// is at least 3, because fewer segments would change the mean of a strand's alpha, which falls along the
/// strand as 1 - t^3. `length` is above 0; `most` is 1 to 7.
int segments_on_screen(const Camera& camera, const DepthRange& range, float length, int most);

}  // namespace pelage::strands
