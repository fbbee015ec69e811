// Draws scenes on the OpenCL device, for comparison with the reference.
#pragma once
#include <memory>
#include <string>

#include "harness/shells/opencl/shells.hpp"
#include "tests/support/pictures.hpp"

namespace pelage::pictures {

/// Returns the device that $PELAGE_DEVICE names, or the first usable device.
cl::Device device();

/// Draws the picture after `frames` frames.
Picture drawn_with(const std::shared_ptr<const FrameInput>& input, const ShellOptions& options);
Picture drawn_by_device(const std::shared_ptr<const FrameInput>& input, const std::string& mapping);

/// Whether the device draws the frame like the reference (same()).
testing::AssertionResult drawn_alike(const std::shared_ptr<const FrameInput>& input,
                                     const std::string& mapping, std::size_t least_pixels = 0);

/// The absolute differences of the red, green and blue of two pictures of equal size, over all pixels.
struct Change {
  double mean = 0, most = 0;
};
Change change(const Picture& a, const Picture& b);

}  // namespace pelage::pictures
