// A mapping assigns the pixels of a frame to the work-items of a device. Each mapping is a class with the
// interface in this file.
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
  /// Makes the lists of the triangles that may touch each tile, in the mesh's order: buffers.list_start and
  /// buffers.list. It reads buffers.corner and buffers.box, and enlarges the lists as needed. Throws
  /// DeviceError for 2^31 entries or more.
  virtual void bin(const cl::Queue& queue, const RasterParams& params, RasterBuffers& buffers,
                   PhaseEvents* events) = 0;
  /// Draws the layers of the pass that `params` describes. It uses the lists that bin() made.
  virtual cl::Event draw(const cl::Queue& queue, const RasterParams& params,
                         const RasterBuffers& buffers) = 0;
  /// Returns the number of counters that buffers.covered needs.
  virtual std::size_t counters(const RasterParams& params) const = 0;
  virtual std::vector<const cl::Program*> programs() const = 0;
};

/// The arguments for making a mapping. `geometry` must outlive the mapping.
struct MappingSetup {
  const cl::Device& device;
  const cl::Program& geometry;  ///< program built from rasterize/geometry/geometry.cl
  std::string options;          ///< build options of the mapping's programs: LANES and the tuning axes
};

struct MappingKind {
  std::string_view name;                ///< name in --mapping, in experiment files and in result rows
  std::string_view what;                ///< description for --help, one line
  std::string_view kernel;              ///< name of the drawing kernel
  bool one_eye_per_pixel;               ///< computes the view direction once per pixel; false: once per fragment
  int (*lanes)(const cl::DeviceInfo&);  ///< lanes of its kernels and of the vertex kernels: 1 or 16
  Tuning (*tuning)(Tuning);             ///< sets the axis values that this mapping fixes or prefers
  std::unique_ptr<Mapping> (*make)(const MappingSetup&);
};

// Each is defined in a file of its own. mappings.cpp lists them.
extern const MappingKind tile_mapping, pixel_mapping, workgroup_mapping;

extern const std::span<const MappingKind* const> mapping_kinds;  ///< all of them

/// Returns the mapping called `name`, or the device's default mapping for "". Throws InputError with the list
/// of names if no mapping has this name.
const MappingKind& mapping_named(const std::string& name, const cl::DeviceInfo& device);

/// Makes a mapping that counts the covered, shaded and blended fragments of about one pixel in `every`. It
/// has three counters per pixel.
std::unique_ptr<Mapping> tally_mapping(MappingSetup setup, int every);

}  // namespace pelage::shells
