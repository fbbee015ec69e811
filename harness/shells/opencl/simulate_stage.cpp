#include "harness/shells/opencl/simulate_stage.hpp"

#include <algorithm>

#include "harness/shells/opencl/params.hpp"

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

std::string simulate_options(const FrameInput& input) {
  std::string options;
  if (!input.style.length.empty()) options += " -D LENGTH_MAP=1";
  if (has_contact(input.scene.contact)) options += " -D CONTACT=1";
  return options;
}

}  // namespace

SimulateStage::SimulateStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry,
                             int lanes, const Tuning& tuning)
    : program_(queue.device(), "simulate/simulate.cl", build_options(lanes, {}) + simulate_options(input)),
      step_(program_, "strand_frame"),
      params_(simulate_params(input.scene, geometry)),
      dynamics_(input.scene.dynamics),
      lanes_(lanes),
      local_(std::size_t(tuned(tuning, "SIMULATE_GROUP", 0))),
      gusts_(queue.device(), 2 * std::size_t(input.scene.dynamics.substeps)),
      constants_(queue, std::span<const float>(geometry.strand_constants)),
      state_(queue, std::span<const float>(rest_state(geometry))) {
  if (has_contact(input.scene.contact)) contact_.emplace(queue, input);
}

void SimulateStage::frame(const cl::Queue& queue, int number, cl::PhaseEvents* events) {
  gusts_.write(queue, gust_table(dynamics_, number));
  if (contact_) {
    contact_->set_frame(queue, number);
    step_.with(params_, gusts_, constants_, state_, contact_->table(), contact_->field());
  } else {
    step_.with(params_, gusts_, constants_, state_);
  }
  const auto items = std::size_t(params_.stride / lanes_), group = std::max<std::size_t>(local_, 1);
  cl::Event event = step_.enqueue(queue, (items + group - 1) / group * group, local_);
  if (events) events->emplace_back("simulate", std::move(event));
}

}  // namespace pelage::shells
