#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "harness/error.hpp"
#include "harness/strands/opencl/drawer.hpp"

namespace pelage::strands {

StrandPass::StrandPass(const cl::Queue& queue, const DrawParams& params, const PictureTexts& texts,
                       const DrawerLayout& layout, std::size_t padded, bool shapes)
    : layout_(layout),
      key_program_(queue.device(), texts.keys),
      list_program_(queue.device(), texts.lists),
      draw_program_(queue.device(), texts.draw),
      make_keys_(key_program_, "strand_keys"),
      count_(list_program_, "strand_bin_count"),
      sum_(list_program_, "strand_bin_sum"),
      start_(list_program_, "strand_bin_start"),
      fill_(list_program_, "strand_bin_fill"),
      draw_(draw_program_, layout.group ? "strand_group" : "strand_tiles") {
  const cl::Device& device = queue.device();
  const std::size_t tiles = std::size_t(params.tiles_x) * std::size_t(params.tiles_y);
  rows_ = cl::Buffer<float>(device, padded * (shapes ? SHAPED_ROW : STRAND_ROW));
  curves_ = cl::Buffer<float>(device, 1);
  blocks_ = cl::Buffer<std::uint64_t>(device, padded);
  pairs_ = cl::Buffer<cl::Pair>(device, std::size_t(params.capacity) * std::size_t(params.runs));
  live_ = cl::Buffer<std::int32_t>(device, std::size_t(params.runs));
  chunk_count_ = cl::Buffer<std::int32_t>(device, tiles * std::size_t(params.chunks));
  length_ = cl::Buffer<std::int32_t>(device, tiles);
  list_start_ = cl::Buffer<std::int32_t>(device, tiles + 1);
  taken_ = cl::Buffer<std::int32_t>(device, 1);
  blank_ = cl::uploaded(queue, std::vector<std::uint16_t>(tiles * 16, 0));  // a number for each row of blocks
  image_ = cl::Buffer<glm::vec4>(device, std::size_t(params.width) * std::size_t(params.height));
}

void StrandPass::make_keys(const cl::Queue& queue, const DrawParams& params, const StrandBuffers& strands,
                           const char* phase, cl::PhaseEvents* events) {
  make_keys_.with(params, strands.constants, strands.shapes, strands.keys, strands.layers, rows_, blocks_,
                  pairs_, live_, curves_);
  cl::keep(events, phase, make_keys_.enqueue(queue, std::size_t(params.runs)));
}

void StrandPass::draw(const cl::Queue& queue, const DrawParams& params, const cl::Buffer<std::int32_t>& total,
                      const cl::Buffer<std::int32_t>& film, const cl::Buffer<glm::vec4>& map,
                      const cl::Buffer<glm::vec4>& skin, const char* list_phase, const char* draw_phase,
                      cl::PhaseEvents* events) {
  const auto chunks = std::size_t(params.chunks);
  count_.with(params, total, blocks_, pairs_, chunk_count_);
  cl::keep(events, list_phase, count_.enqueue(queue, chunks, 1));
  sum_.with(params, chunk_count_, length_);
  cl::keep(events, list_phase, sum_.enqueue(queue, length_.size()));
  start_.with(params, length_, list_start_, taken_);
  cl::keep(events, list_phase, start_.enqueue(queue, 1));
  std::array<std::int32_t, 1> sum{};
  list_start_.read(queue, sum, length_.size());
  if (sum[0] == std::numeric_limits<std::int32_t>::max())
    throw DeviceError(
        "the strand lists of the tiles would have 2^31 entries or more: use a smaller picture or fewer strands");
  const auto listed = std::size_t(sum[0]);
  // The kernels load up to 16 elements from any place of a list.
  if (list_.size() < listed + 16) {
    list_ = {};  // frees the memory before the larger buffers are allocated
    spot_ = {};
    list_ = cl::Buffer<std::int32_t>(queue.device(), listed + listed / 4 + 16);
    spot_ = cl::Buffer<std::uint16_t>(queue.device(), listed + listed / 4 + 16);
  }
  fill_.with(params, total, blocks_, pairs_, list_start_, chunk_count_, list_, spot_);
  cl::keep(events, list_phase, fill_.enqueue(queue, chunks, 1));
  draw_.with(params, rows_, film, map, list_start_, list_, spot_, skin, image_, taken_, blank_);
  // A work-group draws a tile, or a work-item draws one tile after the other until no tile is left.
  const std::size_t tiles = length_.size(), pixels = std::size_t(layout_.tile) * std::size_t(layout_.tile);
  const std::size_t items = std::min(tiles, 32 * std::size_t(queue.device().info().compute_units));
  cl::keep(events, draw_phase,
           layout_.group ? draw_.enqueue(queue, tiles * pixels, pixels) : draw_.enqueue(queue, items, 1));
}

namespace {

using cl::copy;

/// The parameters of the map. `params` are those of the picture.
DrawParams map_params(DrawParams params, const LightView& view, int lanes, int tile) {
  params.width = params.height = view.size;
  params.tiles_x = params.tiles_y = (view.size + tile - 1) / tile;
  params.block_side = block_side(tile);
  params.is_map = 1;
  params.back_facing = BACK_DRAWN;
  params.own_segments = 0;
  copy(params.row_x, view.row_x);
  copy(params.row_y, view.row_y);
  copy(params.row_w, view.row_z);
  params.near_depth = -NO_DEPTH;  // the near plane cuts no strand
  params.pixel = view.texel;
  params.half_per_width = 0.5f / view.texel;
  // All strands are listed, so that the lists of the runs follow each other without gaps.
  params.capacity = params.units_per_run * lanes;
  params.keep_curves = 0;
  return params;
}

/// The same parameters with the capacity of the picture, which suffices for all strands in every view.
DrawParams with_capacity(DrawParams map, const DrawParams& picture) {
  map.capacity = picture.capacity;
  return map;
}

}  // namespace

OpacityMap::OpacityMap(const cl::Queue& queue, const DrawParams& params, const LightView& view,
                       const PictureKinds& kinds, const DrawerLayout& picture, std::size_t padded)
    : layout_(map_layout(picture)),
      pass_(queue, with_capacity(map_params(params, view, layout_.lanes, layout_.tile), params),
            picture_texts(kinds, layout_, true, false), layout_, padded, kinds.shapes),
      total_(queue.device(), 1),
      nothing_(queue.device(), 1) {}

void OpacityMap::enqueue(const cl::Queue& queue, const DrawParams& params, const LightView& view,
                         const StrandBuffers& buffers, cl::PhaseEvents* events) {
  const DrawParams p = map_params(params, view, layout_.lanes, layout_.tile);
  if (p.strands != strands_) {
    const std::array<std::int32_t, 1> total{p.strands};
    total_.write(queue, total);
    strands_ = p.strands;
  }
  pass_.make_keys(queue, p, buffers, "shadow", events);
  pass_.draw(queue, p, total_, buffers.film, nothing_, nothing_, "shadow", "shadow", events);
}

void set_map_rows(DrawParams& params, const Camera& camera, const Look& look) {
  const MapRows rows = map_rows(camera, look);
  copy(params.map_x, rows.column);
  copy(params.map_y, rows.row);
  copy(params.map_z, rows.depth);
  params.map_size = look.shadow.size;
  params.per_shadow_length = 1 / look.shadow.length;
}

}  // namespace pelage::strands
