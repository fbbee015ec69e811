// Counts how often the device covers each pixel, using only the public pipeline.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "harness/shells/opencl/shells.hpp"

namespace pelage::pictures {

/// Triangles over a picture. With the default `row_w`, vertices are screen positions in pixels from the image
/// centre, y down. Positions that are multiples of 1/256 below 2^14 are exact.
struct Flat {
  std::vector<glm::vec2> vertex;
  std::vector<glm::uvec3> triangle;
  int width = 0, height = 0;
  glm::vec4 row_w{0, 0, -.5f, 1};  ///< camera row of w; the counted layer is at (x / 2, y / 2, 1)
};

/// Returns how often each pixel is covered, top row first. It draws one layer of black fur with uniform
/// coverage over white, so a pixel that is covered k times keeps (1 - coverage)^k of the white. Counts up to
/// 50 are exact. Throws std::runtime_error if a pixel's value is not such a power.
std::vector<int> covered_counts(const Flat& flat, const ShellOptions& options);

}  // namespace pelage::pictures
