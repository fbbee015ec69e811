// The double-precision reference for the skin below the strands (docs/strands.md, section Skin). It shares no
// code with the kernels.
#pragma once
#include <limits>
#include <vector>

#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/reference/opacity_map.hpp"

namespace pelage::strands::reference {

/// What a pixel shows of the skin.
struct SkinPixel {
  glm::dvec3 colour{0};
  double depth = std::numeric_limits<double>::infinity();  ///< view depth, R; infinite: no skin
};

/// Returns the colour of each vertex of the skin. `shadow` may be null: no shadow.
std::vector<glm::dvec3> skin_colours(const Look& look, const SkinSurface& skin, const ShadowMap* shadow);

/// Returns the pixels of the camera's picture, row by row. `shadow` may be null: no shadow.
std::vector<SkinPixel> skin_pixels(const Camera& camera, const Look& look, const SkinSurface& skin,
                                   const ShadowMap* shadow);

/// Returns the part of a fragment with the view depth z that the skin does not hide.
double before_skin(const SkinPixel& pixel, double z);

}  // namespace pelage::strands::reference
