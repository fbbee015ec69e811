// Draws scenes on the OpenCL device, for comparison with the reference.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/shells/opencl/shells.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/texts.hpp"

namespace pelage::pictures {

/// Returns the device that $PELAGE_DEVICE names, or the first usable device.
inline cl::Device device() {
  static const cl::Device shared = cl::choose_device("");  // keeps the programs that the tests have built
  return shared;
}

inline Shells shells_of(const FrameInput& input, const ShellOptions& options = {}) {
  return Shells(device(), std::make_shared<FrameInput>(input), options);
}

/// Draws the picture after `frames` frames.
inline Picture drawn_with(const std::shared_ptr<const FrameInput>& input, const ShellOptions& options) {
  Shells shells(device(), input, options);
  shells.advance(frames - 1);
  shells.frame();
  return shells.read();
}
Picture drawn_by_device(const std::shared_ptr<const FrameInput>& input, const std::string& mapping);

/// Whether the device draws the frame like the reference (same()).
testing::AssertionResult drawn_alike(const std::shared_ptr<const FrameInput>& input,
                                     const std::string& mapping, std::size_t least_pixels = 0);

/// The absolute differences of the red, green and blue of two pictures of equal size, over all pixels.
struct Change {
  double mean = 0, most = 0;
};
Change change(const Picture& a, const Picture& b);

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
