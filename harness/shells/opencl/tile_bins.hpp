// Makes one list of triangles per tile, for all layers together, with the kernels of
// kernels/rasterize/geometry/bin.clh.
#pragma once
#include "harness/shells/opencl/mapping.hpp"

namespace pelage::shells {

/// A parallel counting sort. One work-item per chunk of triangles counts the chunk's entries for each tile.
/// Prefix sums give the position of these entries in the tile's list. Then the same work-items write the
/// entries.
class TileBins {
 public:
  /// `geometry` is the program built from rasterize/geometry/geometry.cl.
  explicit TileBins(const cl::Program& geometry);
  /// Does the work of Mapping::bin(). It waits until the device has computed the total length of the lists.
  void make(const cl::Queue& queue, const RasterParams& params, RasterBuffers& buffers, PhaseEvents* events);
  /// The number of the next tile to draw. Work-items increment it atomically; make() sets it to 0.
  const cl::Buffer<std::int32_t>& next_tile() const { return next_tile_; }

 private:
  cl::Kernel count_, sum_, start_, fill_;
  cl::Buffer<std::int32_t> chunk_count_, length_, next_tile_;
};

}  // namespace pelage::shells
