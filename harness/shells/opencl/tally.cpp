#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "harness/shells/opencl/group_bins.hpp"
#include "harness/shells/opencl/stages.hpp"

namespace pelage::shells {

Tally RasterStage::tally(const cl::Queue& queue, int every) {
  if (every == 0) every = std::max(1, params_.width * params_.height / 8192);
  const cl::Program program(queue.device(), "rasterize/pixel/pixel.cl",
                            fmt::format("{} -D TALLY={}", one_lane_, every));
  const auto pixels = std::size_t(params_.width) * std::size_t(params_.height);
  // Pixels that are passed over write nothing.
  const cl::Buffer<std::uint32_t> parts(
      queue, std::span<const std::uint32_t>(std::vector<std::uint32_t>(3 * pixels)));
  cl::Kernel kernel(program, "pixel_shells");
  // Coverage counts in every layer.
  const int every_layer = std::exchange(params_.every_layer, 1);
  // The lists of the mapping "pixel", and a picture of its own for what passes leave to the next.
  auto group_bins = std::exchange(group_bins_, nullptr);
  const cl::Buffer<glm::vec4> image(queue.device(), pixels);
  for (int pass = passes() - 1; pass >= 0; --pass) {
    begin_pass(queue, pass, nullptr);
    kernel.with(params_, table_, corner_, screen_, vertex_, tip_, dry_, list_start_, list_, record_, tangent_,
                curl_, fur_, coat_, *mask_, image, parts);
    const cl::Event event = kernel.enqueue(queue, {std::size_t(params_.width), std::size_t(params_.height)});
  }
  group_bins_ = std::move(group_bins);
  params_.every_layer = every_layer;
  const std::vector<std::uint32_t> counted = parts.read(queue);
  Tally sum;
  for (std::size_t i = 0; i < pixels; ++i) {
    sum.covered += counted[3 * i];
    sum.shaded += counted[3 * i + 1];
    sum.blended += counted[3 * i + 2];
  }
  const auto scale = static_cast<std::uint64_t>(every);
  return {scale * sum.covered, scale * sum.shaded, scale * sum.blended};
}

}  // namespace pelage::shells
