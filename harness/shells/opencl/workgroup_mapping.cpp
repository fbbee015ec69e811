// The workgroup mapping, called "group" in options and files (kernels/rasterize/workgroup/). A work-group
// draws a tile of 8 x 8 pixels, and each of its work-items draws one pixel. There is one list of triangles
// per tile and layer batch. A layer batch is a group of consecutive layers. The lists are made by prefix sums
// and a stable sort.
#include <fmt/format.h>

#include <bit>
#include <limits>

#include "harness/cl/radix_sort.hpp"
#include "harness/error.hpp"
#include "harness/shells/opencl/mapping.hpp"

namespace pelage::shells {
namespace {

// Pixels per side of a tile. A tile has 64 pixels, because the kernels store for each triangle a 64-bit mask
// of the pixels that the triangle covers.
constexpr int workgroup_side = 8;
constexpr std::size_t work_items = std::size_t(workgroup_side) * workgroup_side;

std::vector<cl::ProgramText> workgroup_programs(const std::string& options) {
  return {{"rasterize/workgroup/bin.cl", options},
          cl::RadixSort::program_text(),
          {"rasterize/workgroup/workgroup.cl", options}};
}

class WorkgroupMapping : public Mapping {
 public:
  explicit WorkgroupMapping(const MappingSetup& setup)
      : bins_(setup.device, workgroup_programs(setup.options).front()),
        count_(bins_, "group_count"),
        emit_(bins_, "group_emit"),
        starts_(bins_, "group_starts"),
        sort_(setup.device),
        raster_(setup.device, workgroup_programs(setup.options).back()),
        draw_(raster_, "group_shells") {}

  void bin(const cl::Queue& queue, const RasterParams& p, RasterBuffers& b,
           cl::PhaseEvents* events) override {
    const std::size_t items = std::size_t(p.layer_batches) * std::size_t(p.triangles);
    if (items > std::size_t(std::numeric_limits<std::int32_t>::max()))
      throw DeviceError(fmt::format(
          "{} layer batches of {} triangles: the number of batches times the number of triangles must be below 2^31; increase the number of layers per batch (tuning axis GROUP)",
          p.layer_batches, p.triangles));
    const auto keep = [&](cl::Event event) { cl::keep(events, "bin", std::move(event)); };
    if (offset_.size() < items) offset_ = cl::Buffer<std::int32_t>(queue.device(), items);
    count_.with(p, b.corner, b.box, offset_);
    keep(count_.enqueue_loop(queue, items));
    const std::int32_t total = sort_.scan(queue, offset_, items, events, true);
    // The sort kernels divide the entries of all triangle lists into runs of equal length. If `total` is
    // above the following limit, the end index of the last run overflows an int.
    if (total > std::numeric_limits<std::int32_t>::max() - 4096)
      throw DeviceError(
          "the triangle lists of the tiles would have 2^31 - 4096 entries or more: use a smaller picture or more layers per batch (tuning axis GROUP)");
    const auto count = std::size_t(total);
    const std::size_t lists = std::size_t(p.tiles_x) * std::size_t(p.tiles_y) * std::size_t(p.layer_batches);
    if (b.list_start.size() < lists + 1) b.list_start = cl::Buffer<std::int32_t>(queue.device(), lists + 1);
    cl::grow(queue, key_, count + 1);
    cl::grow(queue, b.list, count + 1);
    emit_.with(p, b.corner, b.box, offset_, key_, b.list);
    keep(emit_.enqueue_loop(queue, items));
    sort_.sort(queue, key_, b.list, count, int(std::bit_width(lists - 1)), events);
    starts_.with(p, total, key_, b.list_start);
    keep(starts_.enqueue_loop(queue, count + 1));
  }

  cl::Event draw(const cl::Queue& queue, const RasterParams& p, const RasterBuffers& b) override {
    b.set(draw_, p);
    const std::size_t tiles = std::size_t(p.tiles_x) * std::size_t(p.tiles_y);
    return draw_.enqueue(queue, tiles * work_items);
  }

  std::size_t counters(const RasterParams& p) const override {
    return std::size_t(p.width) * std::size_t(p.height);
  }
  std::vector<const cl::Program*> programs() const override { return {&bins_, &sort_.program(), &raster_}; }

 private:
  cl::Program bins_;
  cl::Kernel count_, emit_, starts_;
  cl::RadixSort sort_;
  cl::Program raster_;
  cl::Kernel draw_;
  cl::Buffer<std::int32_t> offset_, key_;
};

}  // namespace

const MappingKind workgroup_mapping{
    .name = cl::group_mapping,
    .what = "a work-group draws a tile, and each of its work-items draws one pixel",
    .kernel = "group_shells",
    .one_eye_per_pixel = false,
    .lanes = [](const cl::DeviceInfo&) { return 1; },
    .programs = workgroup_programs,
    .tuning =
        [](Tuning tuning) {
          tuning["TILE_W"] = tuning["TILE_H"] = workgroup_side;  // the kernels support only 8 x 8 pixels
          return tuning;
        },
    .make = [](const MappingSetup& setup) -> std::unique_ptr<Mapping> {
      return std::make_unique<WorkgroupMapping>(setup);
    }};

}  // namespace pelage::shells
