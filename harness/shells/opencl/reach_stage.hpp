// The stage that computes what depends on the wetness mask: the dryness of each vertex, and the number of
// layers in which each triangle is drawn.
#pragma once
#include <utility>

#include "harness/cl/program.hpp"
#include "harness/shells/opencl/raster_buffers.hpp"

namespace pelage::shells {

/// Clumps discard fragments in the outer layers (S Algorithm 2; kernels/rasterize/geometry/reach.clh). For a
/// mask that is computed once, the kernel examines each triangle. For a mask that changes in every frame,
/// kernels examine each texel of the mask, which is faster, but draws some triangles in more layers than
/// necessary. With clump.cells "consistent", the layers also depend on the view (footprint_reach.clh), and a
/// mask that changes hides nothing. The picture is the same.
class ReachStage {
 public:
  /// `text`: wet_text(), for `lanes` lanes. `uv` and `corner` are the arrays of
  /// Geometry.
  ReachStage(const cl::Queue& queue, const cl::ProgramText& text, int lanes, const RasterParams& params,
             bool changes, const cl::Buffer<float>& uv, const cl::Buffer<std::int32_t>& corner);
  /// Returns whether in_view() must be called in each frame.
  [[nodiscard]] bool depends_on_view() const { return by_footprint_ && refined_; }
  /// With clump.cells "consistent" and a mask that does not change: chooses the reaches for a view, after the
  /// kernels vertex_records and layer_vertices, whose results are `record` and `box`. Writes the fourth
  /// number of each triangle's row in `corner`. `blocks` is the number of blocks of LANES triangles.
  cl::Event in_view(const cl::Queue& queue, const RasterParams& params, const cl::Buffer<float>& record,
                    const cl::Buffer<float>& box, cl::Buffer<std::int32_t>& corner, std::size_t blocks);
  /// Lets run() compute the layers of each triangle more tightly, where it can: with clump.cells "consistent"
  /// and a mask that does not change. This takes longer than a frame, and later frames take less time.
  /// Returns whether run() must be called again.
  bool refine() { return !std::exchange(refined_, true) && by_footprint_; }
  /// Writes the dryness of each vertex, which is 1 - its wetness. `mask_uv` is the array of Geometry. Appends
  /// the event to `events` in the phase "wet", unless it is null.
  void dry(const cl::Queue& queue, const RasterParams& params, const cl::Buffer<float>& mask_uv,
           RasterBuffers& buffers, cl::PhaseEvents* events);
  /// Writes the fourth number of each triangle's row in buffers.corner. Appends the events to `events` in the
  /// phase "wet", unless it is null.
  void run(const cl::Queue& queue, const RasterParams& params, const cl::Buffer<float>& uv,
           RasterBuffers& buffers, cl::PhaseEvents* events);
  const cl::Program& program() const { return program_; }

 private:
  int lanes_;
  bool changes_, by_footprint_, refined_ = false;
  cl::Program program_;
  cl::Kernel dryness_, triangles_, clumps_, texels_, by_texel_, repeats_, footprints_, in_view_;
  cl::Buffer<std::int32_t> range_;    ///< the mask texels of each triangle
  cl::Buffer<std::int32_t> number_;   ///< the number of the clump of each texel
  cl::Buffer<std::uint16_t> reach_;   ///< the number of layers of each texel
  cl::Buffer<std::uint32_t> repeat_;  ///< the texels with the values of their neighbours, for the footprints
  cl::Buffer<std::int32_t> reaches_;  ///< the number of layers of each triangle, for FOOTPRINTS pixel sizes
};

}  // namespace pelage::shells
