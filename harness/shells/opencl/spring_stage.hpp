// The stage that simulates a mass-spring topology (docs/springs.md). Scenes with a mass-spring topology use
// this stage instead of SimulateStage, which simulates the strands of Silva et al. 2010.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "kernels/rasterize/params.h"

namespace pelage::shells {

/// Simulates a mass-spring topology on the device. Lengths are in R. Velocities are in R per second.
class SpringStage {
 public:
  SpringStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry, int lanes);
  /// Advances the masses by one frame, in dynamics.substeps steps. If dynamics.tolerance is above 0, the
  /// steps have adaptive length instead.
  void frame(const cl::Queue& queue, cl::PhaseEvents* events);
  /// Computes the tip offset B of every drawn vertex (docs/shells.md, section 3). `vertex` is the vertex
  /// table in VERTEX_COLUMNS columns. Returns the columns x, y and z of B, with one value per vertex.
  const cl::Buffer<float>& tips(const cl::Queue& queue, const RasterParams& params,
                                const cl::Buffer<float>& vertex, cl::PhaseEvents* events);
  /// Waits for the queue. Then throws springs::Diverged if a mass has diverged in any step that frame() has
  /// enqueued so far.
  void check(const cl::Queue& queue) const { masses_.check(queue); }
  /// Returns the vector from the base to the top of every stick.
  std::vector<glm::vec3> offsets(const cl::Queue& queue) const { return masses_.offsets(queue); }
  /// Returns the velocity of the top of every stick.
  std::vector<glm::vec3> speeds(const cl::Queue& queue) const { return masses_.speeds(queue); }
  std::vector<const cl::Program*> programs() const { return {&program_, &masses_.program()}; }

 private:
  springs::MassSprings masses_;
  cl::Program program_;
  cl::Kernel tips_;
  cl::Buffer<std::int32_t> stick_;
  cl::Buffer<float> tip_;
  int substeps_, lanes_;
  std::optional<springs::AdaptiveSteps> adaptive_;  // has a value if dynamics.tolerance is above 0
  std::int32_t level_;
};

}  // namespace pelage::shells
