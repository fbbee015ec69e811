// The strands of the mass-spring model as lines over a picture of the fur, as in S Fig. 4 (a).
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
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

}  // namespace pelage::diagrams
