// Lines over a picture of the fur: the strands of the mass-spring model, as in S Fig. 4 (a), and the
// direction of the wind, as in S Fig. 4 (b).
#pragma once
#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::diagrams {

/// Points on a strand from its root to its tip, in R.
using Curve = std::vector<glm::dvec3>;

/// Returns the curves of the strands (docs/shells.md, section 3, without the curl). `tips` are the simulated
/// tips relative to the roots (FrameOutput::tips): one strand per triangle for Silva's model; one per surface
/// point, or per triangle corner, for a mass-spring topology. If there are more than `most` strands, the
/// function takes `most` of them at equal distances in this order.
std::vector<Curve> strand_curves(const FrameInput& input, const std::vector<glm::vec3>& tips,
                                 std::size_t most);

/// Draws the curves as white lines of `width` pixels over `picture`, which has the size of input.camera. A
/// pixel of a line is drawn if no triangle of the base surface is nearer to the eye there. The fur hides no
/// line. Parts of a curve nearer than the near plane are not drawn.
void draw_strands(Picture& picture, const FrameInput& input, const std::vector<Curve>& curves, double width);

/// Whether a pixel of a line is drawn. `along` is the place on the line, 0 at its start and 1 at its end.
using Visible = std::function<bool(int x, int y, double along)>;

/// Blends a line from `a` to `b` over the picture. Positions are in pixels from the picture's upper left
/// corner; pixel (i, j) has its centre at (i + .5, j + .5). `width` is the width of the line in pixels; its
/// border is one pixel wide. colour.a is the opacity. Parts outside the picture, and pixels for which
/// `visible` returns false, are not drawn.
void draw_line(Picture& picture, glm::dvec2 a, glm::dvec2 b, double width, const glm::vec4& colour,
               const Visible& visible = {});

/// Draws a red arrow along dynamics.wind.direction over `picture`, which has the size of input.camera. The
/// arrow's middle is above the picture's centre, an eighth of the height below the upper border. It has the
/// view depth of the origin, so that the arrow has the perspective of the model. In space its length is a
/// quarter of the picture's height at that depth. `width` is the width of its lines in pixels. Throws
/// InputError if the scene has no wind, or if the wind blows along the line of sight.
void draw_wind_arrow(Picture& picture, const FrameInput& input, double width);

}  // namespace pelage::diagrams
