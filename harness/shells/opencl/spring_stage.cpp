#include "harness/scene/keyframes.hpp"
#include "harness/shells/opencl/program_texts.hpp"
#include "harness/shells/opencl/simulate_stage.hpp"
#include "harness/springs/model/scene.hpp"

namespace pelage::shells {
namespace {

springs::MassSprings at_rest(const cl::Queue& queue, const FrameInput& input, int lanes) {
  const springs::SpringNetwork network = springs::network_of(input);
  springs::MassSpringOptions options;
  options.lanes = lanes;
  springs::MassSprings masses(queue, network, springs::dynamics_of(input.scene.dynamics, network), options);
  masses.push(queue, springs::pushes(network, *input.mesh, input.scene.dynamics.poke));
  if (has_contact(input.scene.contact)) masses.collide(queue, input.scene, input.contact_fields);
  return masses;
}

// Returns, for each drawn vertex, the index in masses.offset() of the x component of its stick's vector. A
// padding vertex gets the index of stick 0, so that the kernel reads a valid element.
std::vector<std::int32_t> columns(const springs::MassSprings& masses, const Geometry& g) {
  const std::vector<std::int32_t> of_stick = masses.offset_columns();
  std::vector<std::int32_t> found(std::size_t(g.vertices), of_stick.front());
  for (std::size_t i = 0; i < g.stick.size(); ++i) found[i] = of_stick[g.stick[i]];
  return found;
}

}  // namespace

SpringStage::SpringStage(const cl::Queue& queue, std::shared_ptr<const FrameInput> input,
                         const Geometry& geometry, int lanes)
    : input_(std::move(input)),
      masses_(at_rest(queue, *input_, lanes)),
      program_(queue.device(), sticks_text(lanes)),
      tips_(program_, "stick_tips"),
      stick_(queue, std::span<const std::int32_t>(columns(masses_, geometry))),
      tip_(queue.device(), 3 * std::size_t(geometry.vertices)),
      substeps_(input_->scene.dynamics.substeps),
      lanes_(lanes),
      level_(input_->scene.dynamics.bend == "tangent") {
  const DynamicsScene& scene = input_->scene.dynamics;
  if (!input_->mesh->frames.empty() || forces_change(input_->scene)) {
    const springs::SpringNetwork rest = springs::network_of(*input_);
    sticks_ = {rest, {rest, *input_->mesh, {}}};
  }
  if (scene.tolerance > 0)
    adaptive_.emplace(float(scene.substeps) * scene.step, scene.substeps, scene.tolerance);
}

void SpringStage::push(const cl::Queue& queue, const DynamicsScene& scene) {
  const springs::MovedSticks& now = sticks_->now;
  std::vector<glm::vec3> force = springs::pushes(now.network, now.mesh, scene.poke);
  if (!now.velocity.empty())
    force = springs::with_drag(std::move(force), now.velocity, springs::dynamics_of(scene, now.network).drag);
  masses_.push(queue, force);
}

void SpringStage::follow_skin(const cl::Queue& queue, int number) {
  if (input_->mesh->frames.empty()) return;
  const std::vector<glm::dvec3> before = std::move(sticks_->now.velocity);
  sticks_->now = springs::moved_sticks(*input_, sticks_->rest, number);
  std::vector<glm::vec3> change;
  for (std::size_t i = 0; i < sticks_->now.velocity.size(); ++i)
    change.emplace_back(sticks_->now.velocity[i] - (before.empty() ? glm::dvec3(0) : before[i]));
  masses_.set_skin(queue, sticks_->now.network, change);
  push(queue, input_->scene.dynamics);
}

void SpringStage::frame(const cl::Queue& queue, int number, cl::PhaseEvents* events) {
  if (forces_change(input_->scene)) {
    const DynamicsScene scene = dynamics_of_frame(input_->scene, number);
    masses_.set_forces(queue, sticks_->now.network, springs::dynamics_of(scene, sticks_->now.network));
    push(queue, scene);
  }
  if (masses_.contact()) masses_.contact()->set_frame(queue, number);
  std::vector<cl::Event> launches;
  if (adaptive_)
    adaptive_->advance(queue, masses_, events ? &launches : nullptr);
  else
    masses_.enqueue(queue, substeps_, events ? &launches : nullptr);
  if (!events) return;
  for (cl::Event& launch : launches) events->emplace_back("simulate", std::move(launch));
}

const cl::Buffer<float>& SpringStage::tips(const cl::Queue& queue, const RasterParams& params,
                                           const cl::Buffer<float>& vertex, cl::PhaseEvents* events) {
  tips_.with(params, level_, stick_, masses_.offset(), vertex, tip_);
  cl::keep(events, "transform", tips_.enqueue(queue, std::size_t(params.vertices / lanes_)));
  return tip_;
}

std::vector<const cl::Program*> SpringStage::programs() const {
  std::vector<const cl::Program*> all{&program_, &masses_.program()};
  if (const cl::Program* contact = masses_.contact_program()) all.push_back(contact);
  return all;
}

}  // namespace pelage::shells
