// The tile mapping (kernels/rasterize/tile/). Each work-item draws one tile at a time. If the device is
// faster with vectors of 16 elements, the work-item uses such vectors.
#include <algorithm>

#include "harness/shells/opencl/mapping.hpp"

namespace pelage::shells {
namespace {

std::vector<cl::ProgramText> tile_programs(const std::string& options) {
  return {{"rasterize/tile/tile.cl", options}};
}

class TileMapping : public Mapping {
 public:
  explicit TileMapping(const MappingSetup& setup)
      : bins_(setup.geometry),
        raster_(setup.device, tile_programs(setup.options).front()),
        draw_(raster_, "tile_shells"),
        lanes_(std::size_t(tile_mapping.lanes(setup.device.info()))) {}

  void bin(const cl::Queue& queue, const RasterParams& p, RasterBuffers& b,
           cl::PhaseEvents* events) override {
    bins_.make(queue, p, b, events);
    const std::size_t room = 4 * (b.list.size() + counters(p) * lanes_);
    if (shown_.size() < room) shown_ = cl::Buffer<std::int32_t>(queue.device(), room);
  }

  cl::Event draw(const cl::Queue& queue, const RasterParams& p, const RasterBuffers& b) override {
    b.set(draw_, p, shown_, bins_.next_tile());
    // Each work-item draws tiles until no tile is left. Some platforms assign several work-items to a CPU
    // thread at once. Therefore up to 32 work-items are enqueued per compute unit, so that all threads have
    // work until the end.
    const std::size_t items = 32 * std::size_t(queue.device().info().compute_units);
    return draw_.enqueue(queue, std::min(counters(p), items), 1);
  }

  std::size_t counters(const RasterParams& p) const override {
    return std::size_t(p.tiles_x) * std::size_t(p.tiles_y);
  }
  std::vector<const cl::Program*> programs() const override { return {&raster_}; }

 private:
  TileBins bins_;
  cl::Program raster_;
  cl::Kernel draw_;
  std::size_t lanes_;
  // For each tile: the triangles that are visible in the current layer batch (the group of layers that the
  // work-item draws).
  cl::Buffer<std::int32_t> shown_;
};

}  // namespace

const MappingKind tile_mapping{
    .name = cl::tile_mapping,
    .what = "a work-item draws a tile, with vectors of 16 elements on PoCL's CPU devices",
    .kernel = "tile_shells",
    .one_eye_per_pixel = true,
    .lanes = [](const cl::DeviceInfo& device) { return device.lanes; },
    .programs = tile_programs,
    .tuning = [](Tuning tuning) { return tuning; },
    .make = [](const MappingSetup& setup) -> std::unique_ptr<Mapping> {
      return std::make_unique<TileMapping>(setup);
    }};

}  // namespace pelage::shells
