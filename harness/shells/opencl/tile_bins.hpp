// Lists of triangles per tile for all layers together: kernels/rasterize/geometry/bin.clh.
#pragma once
#include "harness/shells/opencl/mapping.hpp"

namespace pelage::shells {

/// Chunks of triangles count their entries per tile; sums place them; the chunks write them.
class TileBins {
 public:
  /// geometry: of rasterize/geometry/geometry.cl.
  explicit TileBins(const cl::Program& geometry);
  /// As Mapping::bin(). Waits for the lists' length.
  void make(const cl::Queue& queue, const RasterParams& params, RasterBuffers& buffers, PhaseEvents* events);
  /// The number of the next tile that no work-item has taken; make() sets it to 0.
  const cl::Buffer<std::int32_t>& next_tile() const { return next_tile_; }

 private:
  cl::Kernel count_, sum_, start_, fill_;
  cl::Buffer<std::int32_t> chunk_count_, length_, next_tile_;
};

}  // namespace pelage::shells
