#include <fmt/format.h>

#include "harness/shells/stages.hpp"

namespace pelage::shells {

Tally RasterStage::tally(const cl::Queue& queue) {
  const cl::Program program(queue.device(), "rasterize/pixels.cl", one_lane_ + " -D TALLY");
  const auto pixels = std::size_t(params_.width) * std::size_t(params_.height);
  const cl::Buffer<std::uint32_t> parts(queue.device(), 3 * pixels);
  cl::Kernel kernel(program, "pixel_shells");
  kernel.with(params_, table_, corner_, screen_, vertex_, tip_, dry_, list_start_, list_, record_, tangent_,
              curl_, fur_, coat_, *mask_, image_, parts);
  const cl::Event event = kernel.enqueue(queue, {std::size_t(params_.width), std::size_t(params_.height)});
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
