// The stage that transforms vertices to the screen, bins triangles into tiles, and draws the tiles.
#pragma once
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/picture/picture.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "harness/shells/opencl/mapping.hpp"
#include "harness/shells/opencl/raster_buffers.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/opencl/simulate_stage.hpp"
#include "harness/shells/opencl/wet_stage.hpp"

namespace pelage::shells {

/// The stage that computes what depends on the wetness mask: the dryness of each vertex, and the number of
/// layers in which each triangle is drawn. Clumps discard fragments in the outer layers (S Algorithm 2;
/// kernels/rasterize/geometry/reach.clh). For a mask that is computed once, the kernel examines each
/// triangle. For a mask that changes in every frame, kernels examine each texel of the mask, which is faster,
/// but draws some triangles in more layers than necessary. With clump.cells "consistent", the layers also
/// depend on the view (footprint_reach.clh), and a mask that changes hides nothing. The picture is the same.
class ReachStage {
 public:
  /// `text`: wet_text(), for `lanes` lanes. `uv` and `corner` are the arrays of Geometry.
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

class RasterStage {
 public:
  RasterStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry, const WetStage& wet,
              const ShellOptions& options);
  /// Computes the tip offset B of every vertex (docs/shells.md, section 3). B is the weighted mean of the tip
  /// offsets q of the strands around the vertex. `strands` is the state of the strands in STATE_COLUMNS
  /// columns of length `stride`. Returns the columns x, y and z of B. The unit of B is the radius of the
  /// mesh's bounding sphere.
  const cl::Buffer<float>& strand_tips(const cl::Queue& queue, const cl::Buffer<float>& strands, int stride,
                                       cl::PhaseEvents* events);
  /// Runs the kernels whose results depend on the wetness mask. With droplets, they compute the dryness of
  /// each vertex and, if fur.substeps > 1 or shadows are traced, the curl frame of each vertex, and the
  /// number of layers in which each triangle is drawn. The constructor calls this function. Call it again
  /// when the mask has changed. The phase of the kernels is "wet".
  void use_mask(const cl::Queue& queue, cl::PhaseEvents* events);
  /// Draws the following frames with the surface of `geometry`, of the same mesh.
  void set_skin(const cl::Queue& queue, const Geometry& geometry);
  /// Draws one frame. `tips` has the layout of the result of strand_tips(). The buffer `tips` must stay valid
  /// until the next call of frame(), because count() and tally() read it again.
  void frame(const cl::Queue& queue, const cl::Buffer<float>& tips, cl::PhaseEvents* events);
  /// Sets the colliders that push the layers; null without colliders. A scene with colliders cannot be drawn
  /// before this call. `contact` must outlive this stage.
  void collide_with(const ContactStage* contact) { contact_ = contact; }
  const RasterParams& params() const { return params_; }
  /// Changes the values of the camera and of the shading for the following frames (Shells::set_view()).
  bool set_view(const cl::Device& device, const FrameInput& input, const Geometry& geometry);
  /// Returns the vertex table: VERTEX_COLUMNS columns, each with one float per vertex.
  const cl::Buffer<float>& vertex() const { return buffers_.vertex; }
  /// Returns the number of covered fragments of the last frame in all layers. The function draws the frame
  /// again to count them.
  std::uint64_t count(const cl::Queue& queue);
  /// Returns the fragment counts of the last frame, as Shells::tally() describes. The function does not
  /// change the picture.
  Tally tally(const cl::Queue& queue, int every);
  Picture read(const cl::Queue& queue) const;
  /// See Shells::refine().
  void refine(const cl::Queue& queue) {
    if (reach_ && reach_->refine()) use_mask(queue, nullptr);
  }
  std::vector<const cl::Program*> programs() const;

 private:
  // Draws all passes with `mapping`, which must count fragments. Returns the kernels' fragment counters.
  // `mapping` determines whether there is one counter per tile, one per pixel, or three per pixel. The
  // kernels write picture and counts to temporary buffers, so the last frame's picture does not change.
  std::vector<std::uint32_t> counted(const cl::Queue& queue, Mapping& mapping);
  MappingSetup setup(const cl::Device& device, std::string options) const;  // adds maps_
  // Returns the number of passes. There are several passes if the screen positions of all layers do not fit
  // in memory. Passes with higher numbers are drawn earlier: first the passes of sweep 0 (params.h), then
  // those of sweep 1. Within a sweep, passes with higher numbers contain layers farther outside.
  int passes() const;
  void set_pass(int number);
  // Transforms and bins the layers of pass `number`. The caller then calls mapping.draw().
  void begin_pass(const cl::Queue& queue, int number, Mapping& mapping, cl::PhaseEvents* events);

  const MappingKind& kind_;
  Tuning tuning_;
  std::string maps_;  // build options of the scene's maps, colliders and order of blending (style_options())
  const ContactStage* contact_ = nullptr;
  RasterParams params_;
  int lanes_, layers_at_once_;
  cl::Program geometry_;
  cl::Kernel strand_tips_, layers_, facing_, records_, curls_;
  std::unique_ptr<Mapping> mapping_;
  RasterBuffers buffers_;
  cl::Buffer<float> uv_, mask_uv_, weight_, tip_;
  cl::Buffer<std::int32_t> slice_, strand_;
  std::optional<ReachStage> reach_;  ///< empty without droplets
};

/// Returns the number of layers per pass: `wanted` if it is above 0, else as many as fit in memory. The
/// result is at most params.layers. If the result is above params.layer_batch, but below params.layers, the
/// function rounds it down to a multiple of params.layer_batch.
int layers_at_once(const RasterParams& params, int wanted, const cl::Device& device);

}  // namespace pelage::shells
