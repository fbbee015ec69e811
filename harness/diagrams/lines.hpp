// Straight lines in a picture.
#pragma once
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "harness/picture/picture.hpp"

namespace pelage::diagrams {

/// Whether a pixel of a line is drawn. `along` is the place on the line, 0 at its start and 1 at its end.
using Visible = std::function<bool(int x, int y, double along)>;

/// Blends a line from `a` to `b` over the picture. Positions are in pixels from the picture's upper left
/// corner; pixel (i, j) has its centre at (i + .5, j + .5). `width` is the width of the line in pixels; its
/// border is one pixel wide. colour.a is the opacity. Parts outside the picture, and pixels for which
/// `visible` returns false, are not drawn.
void draw_line(Picture& picture, glm::dvec2 a, glm::dvec2 b, double width, const glm::vec4& colour,
               const Visible& visible = {});

}  // namespace pelage::diagrams
