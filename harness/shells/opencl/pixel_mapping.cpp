// The pixel mapping: each work-item draws one pixel, fragment by fragment (kernels/rasterize/pixel/).
#include <fmt/format.h>

#include "harness/shells/opencl/mapping.hpp"

namespace pelage::shells {
namespace {

/// Number of work-items per side of a work-group. With blend.order "depth" a work-item needs 3 kB of private
/// memory, and PoCL keeps the private memory of a work-group on the stack of one thread.
constexpr std::size_t side = 8;

std::vector<cl::ProgramText> programs_with(const std::string& options) {
  return {{"rasterize/pixel/pixel.cl", options}};
}

class PixelMapping : public Mapping {
 public:
  PixelMapping(const MappingSetup& setup, std::size_t counters_per_pixel)
      : bins_(setup.geometry),
        raster_(setup.device, programs_with(setup.options).front()),
        draw_(raster_, "pixel_shells"),
        counters_per_pixel_(counters_per_pixel) {}

  void bin(const cl::Queue& queue, const RasterParams& p, RasterBuffers& b,
           cl::PhaseEvents* events) override {
    bins_.make(queue, p, b, events);
  }
  cl::Event draw(const cl::Queue& queue, const RasterParams& p, const RasterBuffers& b) override {
    b.set(draw_, p);
    return draw_.enqueue(queue, {std::size_t(p.width), std::size_t(p.height)}, {side, side});
  }
  std::size_t counters(const RasterParams& p) const override {
    return counters_per_pixel_ * std::size_t(p.width) * std::size_t(p.height);
  }
  std::vector<const cl::Program*> programs() const override { return {&raster_}; }

 private:
  TileBins bins_;
  cl::Program raster_;
  cl::Kernel draw_;
  std::size_t counters_per_pixel_;
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
                                .programs = programs_with,
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
