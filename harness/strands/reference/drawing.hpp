// The double-precision reference for pictures of strands (docs/strands.md, section Drawing). It draws one
// strand at a time, visits every pixel near each segment, and sorts with std::stable_sort. It shares no code
// with the kernels.
#pragma once
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands::reference {

/// Returns the curve of a strand between three of the key strands `keys`. `first_segment` is the length of
/// the first segment in lengths of the strand, above 0 and below 1. The strand's rank is the number of its
/// fur layer; the caller knows the look, and replaces the rank if the look orders the layers differently.
DrawnStrand between(const std::vector<KeyStrand>& keys, const KeyedStrand& strand, float first_segment);

/// Returns the alpha of strand `number` at the parameter t of its curve.
double alpha_of(const Look& look, const DrawnStrand& strand, std::uint32_t number, double t);

/// Returns the strands that are drawn for the look's fraction and width factor (docs/strands.md, section
/// "Level of detail"), with their widths.
std::vector<DrawnStrand> pruned(const std::vector<DrawnStrand>& strands, const Look& look);

/// Returns the strands to draw, from front to back. The list contains no strands that face away from the
/// camera, none that are nearer than the near plane and none that are beyond a side of the picture. Its
/// operations are those of docs/strands.md in single
/// precision, so that a device must give the same list.
std::vector<Entry> drawing_order(const Camera& camera, const DepthRange& range,
                                 const std::vector<DrawnStrand>& strands);

/// Returns the light F of all fill lights on a surface with the unit normal n.
glm::dvec3 fill_light(const Look& look, glm::dvec3 n);

/// Draws the strands of `order`, which is a result of drawing_order(), above the skin. Without a skin
/// (`skin` is null), the strands hang in front of the background. Alpha of a pixel is 1 on the skin, and the
/// coverage of the strands elsewhere. The values in `look` must be in their valid ranges. All `strands` cast
/// shadows, also those that are not in `order`. The function does not use look.fraction. Stores the number of
/// fragments with an alpha above 0 in `fragments` unless it is null.
Picture draw(const Camera& camera, const Look& look, const std::vector<DrawnStrand>& strands,
             const std::vector<Entry>& order, const SkinSurface* skin = nullptr,
             std::uint64_t* fragments = nullptr);

/// Returns the colour of strand `number` at the parameter t of its curve, if no strand shadows this place.
glm::dvec3 unshadowed_colour(const Camera& camera, const Look& look, const DrawnStrand& strand,
                             std::uint32_t number, double t);

}  // namespace pelage::strands::reference
