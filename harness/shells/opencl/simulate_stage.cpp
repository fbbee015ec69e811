#include "harness/shells/opencl/simulate_stage.hpp"

#include "harness/prepare/strands.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/shells/opencl/params.hpp"
#include "harness/shells/opencl/program_texts.hpp"

namespace pelage::shells {

namespace {

// Returns the state of all strands at rest: each tip is at its rest position (the anchor) with the velocity
// 0.
std::vector<float> rest_state(const Geometry& g) {
  const auto stride = std::size_t(g.strands);
  std::vector<float> state(std::size_t(STATE_COLUMNS) * stride, 0.0f);
  for (std::size_t i = 0; i < 3 * stride; ++i)
    state[std::size_t(TIP_X) * stride + i] = g.strand_constants[std::size_t(ANCHOR_X) * stride + i];
  return state;
}

}  // namespace

SimulateStage::SimulateStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry,
                             int lanes, const Tuning& tuning)
    : program_(queue.device(), simulate_text(input.scene, lanes)),
      step_(program_, "strand_frame"),
      params_(simulate_params(input.scene, geometry)),
      dynamics_(input.scene.dynamics),
      lanes_(lanes),
      group_(std::size_t(tuned(tuning, "SIMULATE_GROUP", 0))),
      gusts_(queue.device(), 2 * std::size_t(input.scene.dynamics.substeps)),
      constants_(queue, std::span<const float>(geometry.strand_constants)),
      state_(queue, std::span<const float>(rest_state(geometry))) {
  if (has_contact(input.scene.contact)) contact_.emplace(queue, input.scene, input.contact_fields);
  if (forces_change(input.scene)) forces_ = {input.scene, input.strands.root, geometry.strand_constants};
}

void SimulateStage::use_forces(const cl::Queue& queue, int number) {
  dynamics_ = dynamics_of_frame(forces_->scene, number);
  set_forces(dynamics_, params_);
  const auto stride = std::size_t(params_.stride);
  for (std::size_t f = 0; f < forces_->root.size(); ++f) {
    const glm::vec2 phase = gust_phase(glm::dvec3(forces_->root[f]), dynamics_.wind);
    forces_->constants[std::size_t(PHASE_COS) * stride + f] = phase.x;
    forces_->constants[std::size_t(PHASE_SIN) * stride + f] = phase.y;
  }
  constants_.write(queue, forces_->constants);
}

void SimulateStage::frame(const cl::Queue& queue, int number, cl::PhaseEvents* events) {
  if (forces_) use_forces(queue, number);
  gusts_.write(queue, gust_table(dynamics_, number));
  if (contact_) {
    contact_->set_frame(queue, number);
    step_.with(params_, gusts_, constants_, state_, contact_->table(), contact_->field());
  } else {
    step_.with(params_, gusts_, constants_, state_);
  }
  cl::keep(events, "simulate", step_.enqueue(queue, std::size_t(params_.stride / lanes_), group_));
}

}  // namespace pelage::shells
