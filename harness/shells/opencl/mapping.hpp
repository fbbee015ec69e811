// A mapping assigns the pixels of a frame to the work-items of a device. Each mapping is a class that
// implements the interface `Mapping`. A tile is a rectangle of pixels.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/scene/scene.hpp"
#include "harness/shells/opencl/program_texts.hpp"
#include "harness/shells/opencl/raster_buffers.hpp"
#include "kernels/rasterize/params.h"

namespace pelage::shells {

class Mapping {
 public:
  virtual ~Mapping() = default;
  /// Makes lists of the triangles that may touch a tile, in the order of the mesh. The mappings `tile` and
  /// `pixel` make one list per tile. The mapping `group` makes one list per tile and layer batch (a group of
  /// consecutive layers). Reads buffers.corner and buffers.box. Writes the lists to buffers.list_start and
  /// buffers.list. Enlarges these two buffers if they are too small. Throws DeviceError if all lists together
  /// have so many entries that their indices need more than 31 bits.
  virtual void bin(const cl::Queue& queue, const RasterParams& params, RasterBuffers& buffers,
                   cl::PhaseEvents* events) = 0;
  /// Draws one pass: the layers from params.first_layer to params.end_layer - 1. Uses the lists that bin()
  /// wrote.
  virtual cl::Event draw(const cl::Queue& queue, const RasterParams& params,
                         const RasterBuffers& buffers) = 0;
  /// Returns the number of elements of buffers.covered, in which draw() counts fragments. A mapping has one
  /// counter per tile, or one or three counters per pixel.
  virtual std::size_t counters(const RasterParams& params) const = 0;
  virtual std::vector<const cl::Program*> programs() const = 0;
};

/// The arguments of MappingKind::make(). `geometry` must outlive the mapping.
struct MappingSetup {
  const cl::Device& device;
  const cl::Program& geometry;  ///< program built from rasterize/geometry/geometry.cl
  std::string options;          ///< the mapping's build options: LANES and tuning axes (program_texts.hpp)
};

struct MappingKind {
  std::string_view name;    ///< name in the option --mapping, in experiment files and in result rows
  std::string_view what;    ///< description for --help, one line
  std::string_view kernel;  ///< name of the drawing kernel
  /// True if the kernel computes the view direction once per pixel. False if the kernel computes it for every
  /// fragment.
  bool one_eye_per_pixel;
  int (*lanes)(const cl::DeviceInfo&);  ///< fragments or vertices that a work-item computes at once: 1 or 16
  /// Returns the texts of the programs of a mapping with these build options, in the order of their use.
  std::vector<cl::ProgramText> (*programs)(const std::string& options);
  Tuning (*tuning)(Tuning);  ///< adds to a Tuning the values that the mapping needs or prefers
  std::unique_ptr<Mapping> (*make)(const MappingSetup&);
};

// Each mapping is defined in its own file. mappings.cpp lists all mappings.
extern const MappingKind tile_mapping, pixel_mapping, workgroup_mapping;

extern const std::span<const MappingKind* const> mapping_kinds;  ///< all mappings

/// Returns the mapping called `name`, or the device's default mapping for "". Throws InputError with the list
/// of names if no mapping has this name.
const MappingKind& mapping_named(const std::string& name, const cl::DeviceInfo& device);

/// Returns the mapping that draws a scene: mapping_named(), but the workgroup mapping instead of the mapping
/// `tile` with blend.order "depth", which `tile` cannot draw.
const MappingKind& mapping_for(const BlendScene& blend, const std::string& name,
                               const cl::DeviceInfo& device);

/// Makes a mapping that draws a random sample of the pixels, about one in `every`. For each of these pixels
/// the mapping counts the covered, shaded and blended fragments in three counters.
std::unique_ptr<Mapping> tally_mapping(MappingSetup setup, int every);

/// Makes one list of triangles per tile, for all layers together, with the kernels of
/// kernels/rasterize/geometry/bin.clh. Sorts triangles into tiles by a parallel counting sort. In the first
/// kernel, each work-item counts the entries that one chunk of triangles adds to the list of each tile.
/// Prefix sums of these counts give the position of the chunk's entries in each list. In the last kernel,
/// each work-item writes the entries of one chunk.
class TileBins {
 public:
  /// `geometry` is the program built from rasterize/geometry/geometry.cl.
  explicit TileBins(const cl::Program& geometry);
  /// Makes the lists that Mapping::bin() describes. The function waits until the device has computed the
  /// total length of the lists.
  void make(const cl::Queue& queue, const RasterParams& params, RasterBuffers& buffers,
            cl::PhaseEvents* events);
  /// Returns the buffer with the number of the next tile to draw. Work-items increment this number
  /// atomically. make() sets it to 0.
  const cl::Buffer<std::int32_t>& next_tile() const { return next_tile_; }

 private:
  cl::Kernel count_, sum_, start_, fill_;
  cl::Buffer<std::int32_t> chunk_count_, length_, next_tile_;
};

}  // namespace pelage::shells
