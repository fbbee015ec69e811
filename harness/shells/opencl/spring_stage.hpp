// The simulation stage of a mass-spring topology. It replaces SimulateStage.
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

/// Simulates a mass-spring topology on the device.
class SpringStage {
 public:
  SpringStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry, int lanes);
  /// Advances the masses by one frame. It takes dynamics.substeps steps, or adaptive steps if the scene has a
  /// tolerance.
  void frame(const cl::Queue& queue, PhaseEvents* events);
  /// Computes B of docs/frame.md, section 3, at every drawn vertex. `vertex` has VERTEX_COLUMNS columns.
  /// Returns three columns of the same length.
  const cl::Buffer<float>& tips(const cl::Queue& queue, const RasterParams& params,
                                const cl::Buffer<float>& vertex, PhaseEvents* events);
  /// Throws springs::Diverged if any mass has diverged so far. Waits for the queue.
  void check(const cl::Queue& queue) const { masses_.check(queue); }
  /// Returns the top minus the base of every stick, in R.
  std::vector<glm::vec3> offsets(const cl::Queue& queue) const { return masses_.offsets(queue); }
  /// Returns the velocity of the top of every stick, in R/s.
  std::vector<glm::vec3> speeds(const cl::Queue& queue) const { return masses_.speeds(queue); }
  std::vector<const cl::Program*> programs() const { return {&program_, &masses_.program()}; }

 private:
  springs::MassSprings masses_;
  cl::Program program_;
  cl::Kernel tips_;
  cl::Buffer<std::int32_t> stick_;
  cl::Buffer<float> tip_;
  int substeps_, lanes_;
  std::optional<springs::AdaptiveSteps> adaptive_;  // set if the scene has a tolerance
  std::int32_t level_;
};

}  // namespace pelage::shells
