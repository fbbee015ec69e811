// The opacity map of the key light in double precision, written from docs/strands.md, section Shadow. It
// shares no code with the kernels.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/strands/drawing/drawing.hpp"

namespace pelage::strands::reference {

/// A fragment of a strand in the light's view.
struct LightFragment {
  double alpha = 0;
  double depth = 0;  ///< R
};

/// The fragments of each texel, row by row, each texel in the order of the strands.
using LightColumns = std::vector<std::vector<LightFragment>>;

/// Returns the fragments of all strands in the light's view.
LightColumns light_columns(const Look& look, const LightView& view, const std::vector<DrawnStrand>& strands);

/// A texel of the opacity map.
struct Texel {
  double first = 0;    ///< z0; least depth of the texel's fragments, R
  double through = 1;  ///< 1 - A; 1 if there is no fragment
  double mean = 0;     ///< mean depth of the texel's fragments, weighted by their alphas, R
};
using OpacityMap = std::vector<Texel>;  ///< row by row

OpacityMap opacity_map(const LightColumns& columns);
OpacityMap opacity_map(const Look& look, const LightView& view, const std::vector<DrawnStrand>& strands);

/// Returns the part of the key light at the depth z (R) behind a texel, as look.shadow.reading defines it.
double texel_light(const Look& look, const Texel& texel, double z);

/// Returns the part of the key light that reaches a point (R, object's frame), as look.shadow.reading defines
/// it.
double key_light(const Look& look, const LightView& view, const OpacityMap& map, glm::dvec3 point);

/// The view of the key light, and its opacity map.
struct ShadowMap {
  LightView view;
  OpacityMap map;
};

}  // namespace pelage::strands::reference
