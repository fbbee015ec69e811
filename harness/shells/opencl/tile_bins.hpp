// Makes one list of triangles per tile, for all layers together, with the kernels of
// kernels/rasterize/geometry/bin.clh.
#pragma once
#include "harness/shells/opencl/mapping.hpp"

namespace pelage::shells {

/// Sorts triangles into tiles by a parallel counting sort. In the first kernel, each work-item counts the
/// entries that one chunk of triangles adds to the list of each tile. Prefix sums of these counts give the
/// position of the chunk's entries in each list. In the last kernel, each work-item writes the entries of one
/// chunk.
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
