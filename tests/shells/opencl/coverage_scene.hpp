// Coverage made visible through the public pipeline: how often did the device draw each pixel?
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "harness/shells/opencl/shells.hpp"

namespace pelage::pictures {

/// Triangles over a picture. Vertices are screen positions in pixels from the image centre, y down, when
/// `row_w` is the default; exact there when they are multiples of 1/256 below 2^14.
struct Flat {
  std::vector<glm::vec2> vertex;
  std::vector<glm::uvec3> triangle;
  int width = 0, height = 0;
  glm::vec4 row_w{0, 0, -.5f, 1};  ///< the layer that counts lies at z = 1, vertices at (x / 2, y / 2)
};

/// How often each pixel is covered, top row first. One layer of black fur of one coverage over white: a pixel
/// that is covered k times keeps (1 - coverage)^k of the white. Exact up to about 50 hits. Throws
/// std::runtime_error when a pixel's value is no such power.
std::vector<int> covered_counts(const Flat& flat, const ShellOptions& options);

}  // namespace pelage::pictures
