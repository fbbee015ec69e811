// Vertices to the screen, triangles to tiles, tiles to pixels.
#pragma once
#include <memory>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "harness/shells/opencl/mapping.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/opencl/wet_stage.hpp"

namespace pelage::shells {

class RasterStage {
 public:
  RasterStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry, const WetStage& wet,
              const ShellOptions& options);
  /// B of docs/frame.md, 3, at every vertex: three columns, the mean of Silva's strands around it. strands:
  /// STATE_COLUMNS columns, `stride` apart.
  const cl::Buffer<float>& strand_tips(const cl::Queue& queue, const cl::Buffer<float>& strands, int stride,
                                       PhaseEvents* events);
  /// Draws with such columns, which outlive the stage's next use.
  void frame(const cl::Queue& queue, const cl::Buffer<float>& tips, PhaseEvents* events);
  const RasterParams& params() const { return params_; }
  const cl::Buffer<float>& vertex() const { return buffers_.vertex; }  ///< VERTEX_COLUMNS columns
  /// Covered fragments of the last frame, all layers, by an extra pass of the mapping.
  std::uint64_t count(const cl::Queue& queue);
  Tally tally(const cl::Queue& queue, int every);  ///< of the last frame; its picture is left alone
  Picture read(const cl::Queue& queue) const;
  /// Wall time of the kernels that run once per mask (dryness, curl frames, the layers that each triangle
  /// reaches), warm, ms.
  double per_mask_ms() const { return per_mask_ms_; }
  std::vector<const cl::Program*> programs() const;

 private:
  void prepare_mask(const cl::Queue& queue, const cl::Buffer<float>& mask_uv);
  // Draws all passes with a mapping that counts into buffers of its own; returns the counts.
  std::vector<std::uint32_t> counted(const cl::Queue& queue, Mapping& mapping);
  MappingSetup setup(const cl::Device& device, const std::string& options) const;
  // Layers that need more memory than they may at once are drawn in passes, number 0 the innermost and last.
  int passes() const;
  void set_pass(int number);
  // All of a pass before its draw().
  void begin_pass(const cl::Queue& queue, int number, Mapping& mapping, PhaseEvents* events);

  const MappingKind& kind_;
  Tuning tuning_;
  RasterParams params_;
  int lanes_, layers_at_once_;
  cl::Program geometry_;
  cl::Kernel strand_tips_, layers_, records_;
  std::unique_ptr<Mapping> mapping_;
  RasterBuffers buffers_;
  cl::Buffer<float> uv_, weight_, tip_;
  cl::Buffer<std::int32_t> slice_, strand_;
  double per_mask_ms_ = 0;
};

/// Layers that a pass draws: all where their screen positions fit, else as many whole layer batches as do, or
/// part of one; `wanted` instead where it is above 0.
int layers_at_once(const RasterParams& params, int wanted, const cl::Device& device);

}  // namespace pelage::shells
