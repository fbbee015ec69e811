// A part of the picture while the reference draws it, and how its fragments are blended (docs/shells.md,
// section 5).
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "harness/picture/picture.hpp"

namespace pelage::reference {

/// A fragment with fur: its 1/w, colour and coverage.
struct FurFragment {
  double inverse_w;
  glm::dvec3 colour;
  double coverage;
};

/// A rectangle of the picture, and the values of its pixels while it is drawn.
struct Tile {
  Window window;
  std::vector<std::uint32_t> faces;  ///< faces that may be visible in the window, in the mesh's order
  std::vector<double> base;          ///< 1/w of the base surface; 0 in pixels that it does not cover
  std::vector<glm::dvec4> colour;    ///< accumulated colour and alpha of each pixel
  /// The fragments of each pixel that are not blended yet, in the order of drawing; only with blend.order
  /// "depth".
  std::vector<std::vector<FurFragment>> waiting;
  std::size_t at(int x, int y) const {
    return std::size_t(y - window.y) * std::size_t(window.width) + std::size_t(x - window.x);
  }
};

void blend_over(const FurFragment& over, glm::dvec4& colour);

/// Blends the waiting fragments of each pixel, the farthest first. Fragments of equal 1/w keep the order of
/// drawing.
void blend_by_depth(Tile& tile);

}  // namespace pelage::reference
