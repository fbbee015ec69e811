#include "harness/shells/opencl/raster_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <numeric>
#include <utility>

#include "harness/error.hpp"
#include "harness/shells/opencl/params.hpp"
#include "harness/shells/opencl/program_texts.hpp"

namespace pelage::shells {
namespace {

// Returns the default number of layers per layer batch. A layer batch is a group of consecutive layers. For
// each tile, the kernels select the visible triangles once per layer batch. Smaller batches repeat this
// selection more often. Larger batches select more triangles that are invisible on some layers of the batch.
int default_batch(int layers) {
  return std::max(4, (layers + 5) / 6);
}

// Returns the width or the height of a tile in pixels. The result is the value of the tuning axis `axis`, a
// compile-time constant of the kernels: "TILE_W" or "TILE_H". The value must be a multiple of 4, because
// tiles consist of pixel blocks of 4 x 4. The value must be at most 32, because the kernels compute coverage
// exactly only in tiles of at most 32 x 32 pixels (edge_from() in kernels/rasterize/coverage/coverage.clh).
// Throws InputError for other values.
int tile_side(const Tuning& tuning, const std::string& axis, int otherwise) {
  const int side = tuned(tuning, axis, otherwise);
  if (side < 4 || side > 32 || side % 4 != 0)
    throw InputError(fmt::format("tuning: {} is {}, but must be a multiple of 4 from 4 to 32", axis, side));
  return side;
}

// Returns the table of triangles with the reach of dry triangles, as the kernel triangle_reach writes it: the
// number of layers plus 1.
std::vector<std::int32_t> dry_corners(std::vector<std::int32_t> corner, int layers) {
  for (std::size_t i = 3; i < corner.size(); i += 4) corner[i] = layers + 1;
  return corner;
}

// Returns the dryness of the vertices of dry fur, as the kernel vertex_dryness writes it: 1, times the factor
// of curl.radius.
std::vector<float> dry_vertices(const Geometry& g) {
  const auto vertices = std::size_t(g.vertices);
  if (g.mask_uv.size() == 2 * vertices) return std::vector<float>(vertices, 1.0f);
  return {g.mask_uv.begin() + 2 * std::ptrdiff_t(vertices), g.mask_uv.end()};
}

constexpr std::int32_t triangles_per_chunk = 1024;

RasterParams tiled(RasterParams p, const Tuning& tuning, const cl::Device& device) {
  p.layer_batch = std::clamp(tuned(tuning, "GROUP", default_batch(p.layers)), 1, p.layers);
  const int tile_w = tile_side(tuning, "TILE_W", TILE_W), tile_h = tile_side(tuning, "TILE_H", TILE_H);
  p.tiles_x = (p.width + tile_w - 1) / tile_w;
  p.tiles_y = (p.height + tile_h - 1) / tile_h;
  const int wanted = std::max(1, tuned(tuning, "CHUNKS", 4)) * int(device.info().compute_units);
  p.chunks = std::clamp((p.triangles + triangles_per_chunk - 1) / triangles_per_chunk, 1, wanted);
  p.every_layer = tuned(tuning, "REACH", 1) == 0 ? 1 : 0;
  p.chunk = ((p.triangles + p.chunks - 1) / p.chunks + 15) / 16 * 16;
  return p;
}

}  // namespace

RasterStage::RasterStage(const cl::Queue& queue, const FrameInput& input, const Geometry& g,
                         const WetStage& wet_stage, const ShellOptions& options)
    : kind_(mapping_for(input.scene.blend, options.mapping, queue.device().info())),
      tuning_(kind_.tuning(options.tuning)),
      maps_(style_options(input.scene)),
      params_(tiled(raster_params(input, g), tuning_, queue.device())),
      lanes_(kind_.lanes(queue.device().info())),
      layers_at_once_(layers_at_once(params_, options.layers_at_once, queue.device())),
      geometry_(queue.device(), geometry_text(input.scene, lanes_, tuning_)),
      strand_tips_(geometry_, "vertex_tips"),
      layers_(geometry_, "layer_vertices"),
      facing_(geometry_, "triangle_facing"),
      records_(geometry_, "vertex_records"),
      curls_(geometry_, "vertex_curls") {
  const cl::Device& device = queue.device();
  // A second thread packs the fur texture while this thread builds the OpenCL programs of the mapping (tile,
  // pixel or workgroup).
  auto packed = std::async(std::launch::async, [&] { return packed_fur(input.fur); });
  mapping_ = kind_.make(setup(device, build_options(lanes_, tuning_)));
  if (by_depth(input.scene.blend) && layers_at_once_ < params_.layers)
    throw InputError(fmt::format(
        "blend.order = depth: only {} of {} layers fit in one pass, but this order needs all; use fewer layers or a smaller mesh",
        layers_at_once_, params_.layers));
  params_.layer_batch = std::min(params_.layer_batch, layers_at_once_);
  set_pass(0);
  uv_ = cl::uploaded(queue, g.uv);
  weight_ = cl::uploaded(queue, g.weight);
  slice_ = cl::uploaded(queue, g.slice);
  strand_ = cl::uploaded(queue, g.strand);
  const auto vertices = std::size_t(g.vertices), screens = vertices * std::size_t(layers_at_once_ + 1);
  tip_ = cl::Buffer<float>(device, 3 * vertices);
  buffers_.tip = &tip_;
  RasterBuffers& b = buffers_;
  b.layer_table = cl::uploaded(queue, styled_layer_table(input, g));
  const bool wet = !input.droplets.empty();
  b.corner = cl::uploaded(queue, wet ? g.corner : dry_corners(g.corner, params_.layers));
  b.screen = cl::Buffer<float>(device, 4 * screens);
  b.box = cl::Buffer<float>(device, 4 * vertices * std::size_t(params_.layer_batches + 1));
  b.vertex = cl::uploaded(queue, g.vertex);
  b.dry = wet ? cl::Buffer<float>(device, vertices) : cl::uploaded(queue, dry_vertices(g));
  b.record = cl::Buffer<float>(device, RECORD * vertices);
  b.tangent = cl::uploaded(queue, g.tangent);
  b.curl = cl::Buffer<float>(device, shades_curls(params_) ? RECORD * vertices : 1);
  b.fur = cl::uploaded(queue, packed.get());
  b.coat = cl::uploaded(queue, packed_coat(input.coat));
  b.mask = &wet_stage.mask();
  b.image = cl::Buffer<glm::vec4>(device, std::size_t(params_.width) * std::size_t(params_.height));
  b.covered = cl::Buffer<std::uint32_t>(device, mapping_->counters(params_));
  mask_uv_ = cl::uploaded(queue, g.mask_uv);
  if (wet)
    reach_.emplace(queue, wet_text(input.scene, lanes_), lanes_, params_, wet_stage.changes(), uv_, b.corner);
  if (reach_ && options.refine) reach_->refine();
  use_mask(queue, nullptr);
}

bool RasterStage::set_view(const cl::Device& device, const FrameInput& input, const Geometry& geometry) {
  RasterParams params = tiled(raster_params(input, geometry), tuning_, device);
  if (params.width != params_.width || params.height != params_.height) return false;
  params.layer_batch = std::min(params.layer_batch, layers_at_once_);
  params_ = params;
  set_pass(0);
  return true;
}

MappingSetup RasterStage::setup(const cl::Device& device, std::string options) const {
  return {device, geometry_, std::move(options) + maps_};
}

void RasterStage::use_mask(const cl::Queue& queue, cl::PhaseEvents* events) {
  if (reach_) reach_->dry(queue, params_, mask_uv_, buffers_, events);
  if (shades_curls(params_)) {
    curls_.with(params_, buffers_.vertex, buffers_.dry, buffers_.layer_table, buffers_.curl);
    cl::keep(events, "wet", curls_.enqueue_loop(queue, std::size_t(params_.vertices)));
  }
  if (reach_) reach_->run(queue, params_, uv_, buffers_, events);
}

void RasterStage::set_skin(const cl::Queue& queue, const Geometry& geometry) {
  buffers_.vertex.write(queue, geometry.vertex);
  buffers_.tangent.write(queue, geometry.tangent);
  use_mask(queue, nullptr);
}

std::vector<const cl::Program*> RasterStage::programs() const {
  std::vector<const cl::Program*> all = mapping_->programs();
  all.push_back(&geometry_);
  if (reach_) all.push_back(&reach_->program());
  return all;
}

const cl::Buffer<float>& RasterStage::strand_tips(const cl::Queue& queue, const cl::Buffer<float>& strands,
                                                  int stride, cl::PhaseEvents* events) {
  strand_tips_.with(params_, slice_, strand_, weight_, strands, std::int32_t(stride), tip_);
  cl::keep(events, "transform", strand_tips_.enqueue(queue, std::size_t(params_.vertices / lanes_)));
  return tip_;
}

void RasterStage::frame(const cl::Queue& queue, const cl::Buffer<float>& tips, cl::PhaseEvents* events) {
  buffers_.tip = &tips;
  records_.with(params_, buffers_.vertex, tips, uv_, buffers_.record);
  cl::keep(events, "transform", records_.enqueue_loop(queue, std::size_t(params_.vertices)));
  for (int pass = passes() - 1; pass >= 0; --pass) {
    begin_pass(queue, pass, *mapping_, events);
    cl::keep(events, "raster", mapping_->draw(queue, params_, buffers_));
  }
}

Picture RasterStage::read(const cl::Queue& queue) const {
  return Picture{params_.width, params_.height, buffers_.image.read(queue)};
}

// If the screen positions of all layers need too much memory, the layers are drawn in several passes. The
// first pass draws the outermost layers, the last pass the innermost. Each pass transforms and bins its own
// layers, and then blends them with the pixel values of the previous pass. With two sweeps (params.h), the
// passes of the triangles that face the eye come first.

namespace {

// Limit of the memory for screen positions, in bytes. A mesh of 5 million triangles in 16 layers needs less
// memory than this limit and is drawn in one pass. The largest case of experiments/silva2010-table1.toml, the
// lion in 64 layers, needs a fifth of the limit.
constexpr std::size_t most_screen_bytes = std::size_t(1) << 30;
constexpr std::size_t screen_bytes = 16;  // bytes per vertex and layer

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
