// How a frame's pixels are spread over a device's work-items: one class per mapping behind one interface.
#pragma once
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/shells/opencl/build_options.hpp"
#include "harness/shells/opencl/phases.hpp"
#include "harness/shells/opencl/raster_buffers.hpp"
#include "kernels/rasterize/params.h"

namespace pelage::shells {

class Mapping {
 public:
  virtual ~Mapping() = default;
  /// Lists the triangles that may touch each tile, in the mesh's order: makes buffers.list_start and
  /// buffers.list from the corners and boxes, as long as they need to be. Throws DeviceError for 2^31 entries
  /// or more.
  virtual void bin(const cl::Queue& queue, const RasterParams& params, RasterBuffers& buffers,
                   PhaseEvents* events) = 0;
  /// Draws the layers of the pass that `params` describes from those lists.
  virtual cl::Event draw(const cl::Queue& queue, const RasterParams& params,
                         const RasterBuffers& buffers) = 0;
  /// Length of the buffer of fragment counts.
  virtual std::size_t counters(const RasterParams& params) const = 0;
  virtual std::vector<const cl::Program*> programs() const = 0;
};

/// What a mapping is built from. The geometry program outlives the mapping.
struct MappingSetup {
  const cl::Device& device;
  const cl::Program& geometry;  ///< of rasterize/geometry/geometry.cl
  std::string options;          ///< -D of its programs: LANES and the tuning axes
};

struct MappingKind {
  std::string_view name;                ///< as users write it: --mapping, variants, rows
  std::string_view what;                ///< one line for --help
  std::string_view kernel;              ///< that draws
  bool one_eye_per_pixel;               ///< computes a pixel's view ray once a frame; false: once a fragment
  int (*lanes)(const cl::DeviceInfo&);  ///< of its kernels and of the vertex kernels, 1 or 16
  Tuning (*tuning)(Tuning);             ///< the axes as the mapping builds its kernels
  std::unique_ptr<Mapping> (*make)(const MappingSetup&);
};

// One per file; mappings.cpp lists them.
extern const MappingKind tile_mapping, pixel_mapping, workgroup_mapping;

extern const std::span<const MappingKind* const> mapping_kinds;  ///< all of them

/// The mapping of that name; "": the device's default. Throws InputError naming those there are.
const MappingKind& mapping_named(const std::string& name, const cl::DeviceInfo& device);

/// Counts the covered, shaded and blended fragments of one pixel in `every`, three counters per pixel.
std::unique_ptr<Mapping> tally_mapping(MappingSetup setup, int every);

}  // namespace pelage::shells
