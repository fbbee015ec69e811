// The stages that simulate the strands of S, or the sticks of a mass-spring topology.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "harness/cl/buffer.hpp"
#include "harness/cl/program.hpp"
#include "harness/contact/opencl/contact_stage.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "harness/shells/opencl/program_texts.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "kernels/rasterize/params.h"
#include "kernels/simulate/params.h"

namespace pelage::shells {

/// Simulates all strands. Eq. 2 of S moves the tips, and Eq. 3 limits their positions.
class SimulateStage {
 public:
  SimulateStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry, int lanes,
                const Tuning& tuning = {});
  /// Simulates frame number `number`, counted from 0.
  void frame(const cl::Queue& queue, int number, cl::PhaseEvents* events);
  /// Returns the colliders of the last frame; null if the scene has none.
  const ContactStage* contact() const { return contact_ ? &*contact_ : nullptr; }
  /// Returns the tips and velocities of the strands: STATE_COLUMNS columns of stride() floats.
  const cl::Buffer<float>& state() const { return state_; }
  int stride() const { return params_.stride; }
  const cl::Program& program() const { return program_; }

 private:
  cl::Program program_;
  cl::Kernel step_;
  SimulateParams params_;
  DynamicsScene dynamics_;
  int lanes_;
  std::size_t group_;  // number of work-items per work-group; 0: cl::usual_group()
  /// What a scene with keyframes of forces needs in every frame.
  struct Forces {
    Scene scene;
    std::vector<glm::vec3> root;
    std::vector<float> constants;
  };
  void use_forces(const cl::Queue& queue, int number);

  std::optional<Forces> forces_;
  cl::Buffer<float> gusts_, constants_, state_;
  std::optional<ContactStage> contact_;
};

/// Simulates a mass-spring topology (docs/springs.md) on the device, instead of SimulateStage. Lengths are in
/// R. Velocities are in R per second.
class SpringStage {
 public:
  SpringStage(const cl::Queue& queue, std::shared_ptr<const FrameInput> input, const Geometry& geometry,
              int lanes);
  /// Places the sticks on the skin of frame number `number`, if the skin deforms. Call it before
  /// frame(number).
  void follow_skin(const cl::Queue& queue, int number);
  /// Advances the masses by frame number `number`, counted from 0, in dynamics.substeps steps. If
  /// dynamics.tolerance is above 0, the steps have adaptive length instead.
  void frame(const cl::Queue& queue, int number, cl::PhaseEvents* events);
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
  /// Returns the colliders of the last frame; null if the scene has none.
  const ContactStage* contact() { return masses_.contact(); }
  std::vector<const cl::Program*> programs() const;

 private:
  void push(const cl::Queue& queue, const DynamicsScene& scene);

  std::shared_ptr<const FrameInput> input_;  ///< with the skin at rest
  springs::MassSprings masses_;
  /// What a scene with keyframes of forces, or with a skin that deforms, needs in every frame: the sticks at
  /// rest, and those of the last frame. `velocity` is empty if the skin does not deform.
  struct Sticks {
    springs::SpringNetwork rest;
    springs::MovedSticks now;
  };
  std::optional<Sticks> sticks_;
  cl::Program program_;
  cl::Kernel tips_;
  cl::Buffer<std::int32_t> stick_;
  cl::Buffer<float> tip_;
  int substeps_, lanes_;
  std::optional<springs::AdaptiveSteps> adaptive_;  // has a value if dynamics.tolerance is above 0
  std::int32_t level_;
};

}  // namespace pelage::shells
