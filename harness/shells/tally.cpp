#include <fmt/format.h>

#include <utility>

#include "harness/shells/stages.hpp"

namespace pelage::shells {

Tally RasterStage::tally(const cl::Queue& queue) {
  const cl::Program program(queue.device(), "rasterize/pixels.cl", one_lane_ + " -D TALLY");
  const auto pixels = std::size_t(params_.width) * std::size_t(params_.height);
  const cl::Buffer<std::uint32_t> parts(queue.device(), 3 * pixels);
  cl::Kernel kernel(program, "pixel_shells");
  // Coverage counts in every layer.
  const int every_layer = std::exchange(params_.every_layer, 1);
  bin(queue, nullptr);
  kernel.with(params_, table_, corner_, screen_, vertex_, tip_, dry_, list_start_, list_, record_, tangent_,
              curl_, fur_, coat_, *mask_, image_, parts);
  const cl::Event event = kernel.enqueue(queue, {std::size_t(params_.width), std::size_t(params_.height)});
  params_.every_layer = every_layer;
  const std::vector<std::uint32_t> counted = parts.read(queue);
  Tally sum;
  for (std::size_t i = 0; i < pixels; ++i) {
    sum.covered += counted[3 * i];
    sum.shaded += counted[3 * i + 1];
    sum.blended += counted[3 * i + 2];
  }
  return sum;
}

}  // namespace pelage::shells
