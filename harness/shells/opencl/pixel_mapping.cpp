// The pixel mapping: each work-item draws one pixel, fragment by fragment (kernels/rasterize/pixel/).
#include <fmt/format.h>

#include "harness/shells/opencl/tile_bins.hpp"

namespace pelage::shells {
namespace {

/// Returns the number of work-items per side of a work-group: at most 8. With blend.order "depth" a work-item
/// needs 3 kB of private memory, and PoCL keeps the private memory of a work-group on the stack of one
/// thread.
std::size_t side_of_group(const cl::DeviceInfo& device) {
  std::size_t side = 8;
  while (side > 1 && side * side > device.max_work_group) side /= 2;
  return side;
}

/// Rounds a side of the picture up to a multiple of `side`. The kernel skips the pixels outside the picture.
std::size_t up(int pixels, std::size_t side) {
  return (std::size_t(pixels) + side - 1) / side * side;
}

class PixelMapping : public Mapping {
 public:
  PixelMapping(const MappingSetup& setup, std::size_t counters_per_pixel)
      : bins_(setup.geometry),
        raster_(setup.device, "rasterize/pixel/pixel.cl", setup.options),
        draw_(raster_, "pixel_shells"),
        side_(side_of_group(setup.device.info())),
        counters_per_pixel_(counters_per_pixel) {}

  void bin(const cl::Queue& queue, const RasterParams& p, RasterBuffers& b,
           cl::PhaseEvents* events) override {
    bins_.make(queue, p, b, events);
  }
  cl::Event draw(const cl::Queue& queue, const RasterParams& p, const RasterBuffers& b) override {
    b.set(draw_, p);
    return draw_.enqueue(queue, {up(p.width, side_), up(p.height, side_)}, {side_, side_});
  }
  std::size_t counters(const RasterParams& p) const override {
    return counters_per_pixel_ * std::size_t(p.width) * std::size_t(p.height);
  }
  std::vector<const cl::Program*> programs() const override { return {&raster_}; }

 private:
  TileBins bins_;
  cl::Program raster_;
  cl::Kernel draw_;
  std::size_t side_, counters_per_pixel_;
};

}  // namespace

std::unique_ptr<Mapping> tally_mapping(MappingSetup setup, int every) {
  setup.options += fmt::format(" -D TALLY={}", every);
  return std::make_unique<PixelMapping>(setup, 3);
}

const MappingKind pixel_mapping{.name = "pixel",
                                .what = "a work-item draws a pixel, one fragment after the other",
                                .kernel = "pixel_shells",
                                .one_eye_per_pixel = false,
                                .lanes = [](const cl::DeviceInfo&) { return 1; },
                                .tuning =
                                    [](Tuning tuning) {
                                      // The default tiles are small, because a work-item reads the whole
                                      // triangle list of its tile for every layer, and smaller tiles have
                                      // shorter lists.
                                      tuning.insert({{"TILE_W", 8}, {"TILE_H", 8}});
                                      return tuning;
                                    },
                                .make = [](const MappingSetup& setup) -> std::unique_ptr<Mapping> {
                                  return std::make_unique<PixelMapping>(setup, 1);
                                }};

}  // namespace pelage::shells
