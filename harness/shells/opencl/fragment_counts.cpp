// Draws the last frame again and counts its fragments.
#include <algorithm>
#include <numeric>
#include <utility>

#include "harness/shells/opencl/raster_stage.hpp"

namespace pelage::shells {

std::vector<std::uint32_t> RasterStage::counted(const cl::Queue& queue, Mapping& mapping) {
  // The counters start at 0, because the kernels write no counter for pixels that they skip. Temporary
  // buffers replace buffers_.image and buffers_.covered, so that the picture of the last frame stays
  // unchanged.
  const std::vector<std::uint32_t> zeros(mapping.counters(params_));
  auto covered = std::exchange(buffers_.covered, {queue, std::span<const std::uint32_t>(zeros)});
  auto image = std::exchange(buffers_.image, {queue.device(), buffers_.image.size()});
  // If every_layer is 0, the kernels skip a triangle in each layer in which the clumping of wet fur
  // (docs/shells.md, section 6) discards all fragments of the triangle. With every_layer = 1 the kernels draw
  // each triangle in all layers, so they also count these fragments.
  const int every_layer = std::exchange(params_.every_layer, 1);
  for (int pass = passes() - 1; pass >= 0; --pass) {
    begin_pass(queue, pass, mapping, nullptr);
    const cl::Event event = mapping.draw(queue, params_, buffers_);
  }
  queue.finish();
  params_.every_layer = every_layer;
  buffers_.image = std::move(image);
  return std::exchange(buffers_.covered, std::move(covered)).read(queue);
}

std::uint64_t RasterStage::count(const cl::Queue& queue) {
  const auto counting =
      kind_.make(setup(queue.device(), build_options(lanes_, tuning_) + " -D COUNT_FRAGMENTS"));
  const std::vector<std::uint32_t> parts = counted(queue, *counting);
  return std::accumulate(parts.begin(), parts.end(), std::uint64_t(0));
}

Tally RasterStage::tally(const cl::Queue& queue, int every) {
  if (every == 0) every = std::max(1, params_.width * params_.height / 8192);
  const auto counting = tally_mapping(setup(queue.device(), build_options(1, tuning_)), every);
  const std::vector<std::uint32_t> parts = counted(queue, *counting);
  Tally sum;
  for (std::size_t i = 0; i < parts.size(); i += 3) {
    sum.covered += parts[i];
    sum.shaded += parts[i + 1];
    sum.blended += parts[i + 2];
  }
  const auto scale = static_cast<std::uint64_t>(every);
  return {scale * sum.covered, scale * sum.shaded, scale * sum.blended};
}

}  // namespace pelage::shells
