// The stage that finds the number of layers in which each triangle is drawn, from the wetness mask.
#pragma once
#include "harness/cl/phases.hpp"
#include "harness/cl/program.hpp"
#include "kernels/rasterize/params.h"

namespace pelage::shells {

/// Clumps discard fragments in the outer layers (S Algorithm 2; kernels/rasterize/geometry/reach.clh). For a
/// mask that is computed once, the kernel examines each triangle. For a mask that changes in every frame,
/// kernels examine each texel of the mask, which is faster, but draws some triangles in more layers than
/// necessary. With clump.cells "consistent", the layers also depend on the view (footprint_reach.clh), and a
/// mask that changes hides nothing. The picture is the same.
class ReachStage {
 public:
  /// `geometry` is the program rasterize/geometry/geometry.cl. `uv` and `corner` are the arrays of Geometry.
  ReachStage(const cl::Queue& queue, const cl::Program& geometry, const RasterParams& params, bool changes,
             const cl::Buffer<float>& uv, const cl::Buffer<std::int32_t>& corner);
  /// Returns whether in_view() must be called in each frame.
  [[nodiscard]] bool depends_on_view() const { return by_footprint_; }
  /// With clump.cells "consistent" and a mask that does not change: chooses the reaches for a view, after the
  /// kernels vertex_records and layer_vertices, whose results are `record` and `box`. Writes the fourth
  /// number of each triangle's row in `corner`. `items` is the number of work-items.
  cl::Event in_view(const cl::Queue& queue, const RasterParams& params, const cl::Buffer<float>& record,
                    const cl::Buffer<float>& box, cl::Buffer<std::int32_t>& corner, std::size_t items);
  /// Writes the fourth number of each triangle's row in `corner`. Appends the events to `events` in the phase
  /// "wet", unless it is null.
  void run(const cl::Queue& queue, const RasterParams& params, const cl::Buffer<float>& layer_table,
           const cl::Buffer<float>& uv, const cl::Buffer<float>& mask, cl::Buffer<std::int32_t>& corner,
           cl::PhaseEvents* events);

 private:
  bool changes_, by_footprint_;
  cl::Kernel triangles_, clumps_, texels_, by_texel_, footprints_, in_view_;
  cl::Buffer<std::int32_t> range_;    ///< the mask texels of each triangle
  cl::Buffer<std::int32_t> number_;   ///< the number of the clump of each texel
  cl::Buffer<std::uint16_t> reach_;   ///< the number of layers of each texel
  cl::Buffer<std::int32_t> reaches_;  ///< the number of layers of each triangle, for FOOTPRINTS pixel sizes
};

/// Returns the number of work-items that process `count` triangles, vertices, texels or blocks of them. The
/// kernel must loop over them with the step get_global_size(0). PoCL copies the parameters for every
/// work-item, so on a CPU a work-item processes many.
std::size_t work_items(const cl::Device& device, int count);

}  // namespace pelage::shells
