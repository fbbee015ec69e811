// The stage that a mass-spring topology takes in place of Silva's strands, and what it is to move.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "harness/shells/opencl/phases.hpp"
#include "harness/springs/opencl/adaptive.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "kernels/rasterize/params.h"

namespace pelage::shells {

/// The topology on the device.
class SpringStage {
 public:
  SpringStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry, int lanes);
  /// The scene's substeps, or as many as its tolerance takes.
  void frame(const cl::Queue& queue, PhaseEvents* events);
  /// B of docs/frame.md, 3, at every drawn vertex: three columns. vertex: VERTEX_COLUMNS columns of the same
  /// length.
  const cl::Buffer<float>& tips(const cl::Queue& queue, const RasterParams& params,
                                const cl::Buffer<float>& vertex, PhaseEvents* events);
  /// Throws springs::Diverged when a mass was lost in a step so far; waits for the queue.
  void check(const cl::Queue& queue) const { masses_.check(queue); }
  /// Top less base of every stick, R.
  std::vector<glm::vec3> offsets(const cl::Queue& queue) const { return masses_.offsets(queue); }
  /// Velocity of every top, R/s.
  std::vector<glm::vec3> speeds(const cl::Queue& queue) const { return masses_.speeds(queue); }
  std::vector<const cl::Program*> programs() const { return {&program_, &masses_.program()}; }

 private:
  springs::MassSprings masses_;
  cl::Program program_;
  cl::Kernel tips_;
  cl::Buffer<std::int32_t> stick_;
  cl::Buffer<float> tip_;
  int substeps_, lanes_;
  std::optional<springs::AdaptiveSteps> adaptive_;  // where the scene has a tolerance
  std::int32_t level_;
};

}  // namespace pelage::shells
