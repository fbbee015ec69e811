// The direction of the wind as a red arrow over a picture, as in S Fig. 4 (b).
#pragma once
#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::diagrams {

/// Draws a red arrow along dynamics.wind.direction over `picture`, which has the size of input.camera. The
/// arrow's middle is above the picture's centre, an eighth of the height below the upper border. It has the
/// view depth of the origin, so that the arrow has the perspective of the model. In space its length is a
/// quarter of the picture's height at that depth. `width` is the width of its lines in pixels. Throws
/// InputError if the scene has no wind, or if the wind blows along the line of sight.
void draw_wind_arrow(Picture& picture, const FrameInput& input, double width);

}  // namespace pelage::diagrams
