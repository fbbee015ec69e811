// If the screen positions of all layers need too much memory, the layers are drawn in several passes. The
// first pass draws the outermost layers, the last pass the innermost. Each pass transforms and bins its own
// layers, and then blends them with the pixel values of the previous pass. With two sweeps (params.h), the
// passes of the triangles that face the eye come first.
#include <algorithm>
#include <numeric>
#include <utility>

#include "harness/shells/opencl/raster_stage.hpp"

namespace pelage::shells {
namespace {

// Limit of the memory for screen positions, in bytes. A mesh of 5 million triangles in 16 layers needs less
// memory than this limit and is drawn in one pass. The largest case of experiments/silva2010-table1.toml, the
// lion in 64 layers, needs a fifth of the limit.
constexpr std::size_t most_screen_bytes = std::size_t(1) << 30;
constexpr std::size_t screen_bytes = 16;  // bytes per vertex and layer
// Drawing the last frame again to count its fragments.

}  // namespace

int layers_at_once(const RasterParams& p, int wanted, const cl::Device& device) {
  const std::size_t most = std::min<std::size_t>(most_screen_bytes, device.info().max_allocation);
  const std::size_t rows = std::max<std::size_t>(2, most / (screen_bytes * std::size_t(p.vertices)));
  const int fit = wanted > 0 ? wanted : int(std::min(rows - 1, std::size_t(p.layers)));
  if (fit >= p.layers) return p.layers;
  return fit > p.layer_batch ? fit / p.layer_batch * p.layer_batch : fit;
}

int RasterStage::passes() const {
  const int parts = (params_.layers + layers_at_once_ - 1) / layers_at_once_;
  return parts == 1 ? 1 : parts * params_.sweeps;
}

void RasterStage::set_pass(int number) {
  const int parts = (params_.layers + layers_at_once_ - 1) / layers_at_once_;
  params_.first_sweep = parts == 1 ? 0 : params_.sweeps - 1 - number / parts;
  params_.end_sweep = parts == 1 ? params_.sweeps : params_.first_sweep + 1;
  params_.first_layer = number % parts * layers_at_once_;
  params_.end_layer = std::min(params_.first_layer + layers_at_once_, params_.layers);
  const int layers = params_.end_layer - params_.first_layer;
  params_.layer_batches = 1 + (layers + params_.layer_batch - 1) / params_.layer_batch;
}

void RasterStage::begin_pass(const cl::Queue& queue, int number, Mapping& mapping, cl::PhaseEvents* events) {
  set_pass(number);
  const RasterBuffers& b = buffers_;
  if (contact_)
    layers_.with(params_, b.vertex, *b.tip, b.dry, b.layer_table, b.screen, b.box, contact_->table(),
                 contact_->field(), std::int32_t(contact_->last()));
  else
    layers_.with(params_, b.vertex, *b.tip, b.dry, b.layer_table, b.screen, b.box);
  cl::keep(events, "transform", layers_.enqueue(queue, std::size_t(params_.vertices / lanes_)));
  const auto blocks = std::size_t((params_.triangles + lanes_ - 1) / lanes_);
  if (reach_ && reach_->depends_on_view())
    cl::keep(events, "transform", reach_->in_view(queue, params_, b.record, b.box, buffers_.corner, blocks));
  if (params_.faces != FACES_ALL) {
    facing_.with(params_, b.corner, b.screen, b.vertex, *b.tip, b.dry, b.layer_table);
    cl::keep(events, "transform", facing_.enqueue_loop(queue, blocks));
  }
  mapping.bin(queue, params_, buffers_, events);
}

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
