// Counts how many triangles the device draws at each pixel. The counting uses only the public interface of
// the class Shells.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "harness/shells/opencl/shells.hpp"

namespace pelage::pictures {

/// Triangles in front of the camera. With the default `row_w`, vertices are screen positions in pixels
/// relative to the image centre, with y pointing down. If a coordinate is a multiple of 1/256 pixel and
/// below 2^14 pixels, the projection to the screen does not round it.
struct Flat {
  std::vector<glm::vec2> vertex;
  std::vector<glm::uvec3> triangle;
  int width = 0, height = 0;
  /// The last row of the camera matrix. Its dot product with (position, 1) is the clip coordinate w. The
  /// triangles are drawn in a layer of fur at z = 1. In this layer, a vertex (x, y) has the position (x / 2,
  /// y / 2, 1).
  glm::vec4 row_w{0, 0, -.5f, 1};
};

/// Returns the number of triangles that cover each pixel, top row first. The function draws one layer of
/// black fur with the constant opacity a over white skin. A pixel that k triangles cover has the brightness
/// (1 - a)^k, from which the function computes k. Counts up to 50 are exact. Throws std::runtime_error if the
/// brightness of a pixel gives no whole number k.
std::vector<int> covered_counts(const Flat& flat, const ShellOptions& options);

}  // namespace pelage::pictures
