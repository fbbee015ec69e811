#include "harness/strands/opencl/strands.hpp"

#include <fmt/format.h>

#include "harness/error.hpp"
#include "harness/scene/keyframes.hpp"

namespace pelage::strands {
Drawing drawing_named(const std::string& name) {
  if (name.empty()) return Drawing::standard;
  if (name == cl::tile_mapping) return Drawing::item;
  if (name == cl::group_mapping) return Drawing::group;
  throw InputError(fmt::format("mapping {}: strands have the mappings {} and {}", name, cl::tile_mapping,
                               cl::group_mapping));
}

Strands::Strands(const cl::Device& device, std::shared_ptr<const StrandInput> input,
                 const DrawerOptions& options)
    : queue_(device),
      input_(std::move(input)),
      chains_(queue_, input_->fur.chains, input_->dynamics),
      drawer_(queue_, *input_, input_->fur.strands, input_->fur.keys.size(), options) {
  if (has_contact(input_->scene.contact)) chains_.collide(queue_, input_->scene, input_->contact_fields);
  if (input_->mesh->frames.empty()) return;
  skin_.emplace(input_->scene, input_->mesh, input_->fur, input_->skin);
  skin_->advance();
  before_ = skin_->frame();
}

void Strands::follow_skin() {
  if (!skin_ || followed_) return;
  before_ = skin_->frame();
  skin_->advance();
  chains_.set_skin(queue_, before_, skin_->frame(), input_->scene.dynamics.substeps);
  if (skin_->surface()) drawer_.deform_skin(queue_, *skin_->surface());
  queue_.finish();
  followed_ = true;
}

void Strands::use_forces() {
  const int frame = int(chains_.steps() / input_->scene.dynamics.substeps);
  if (ContactStage* contact = chains_.contact()) contact->set_frame(queue_, frame);
  if (!forces_change(input_->scene)) return;
  chains_.set_forces(queue_, input_->fur.chains, dynamics_of_frame(*input_, frame));
}

void Strands::move(cl::PhaseEvents* events) {
  followed_ = false;
  use_forces();
  chains_.enqueue(queue_, input_->scene.dynamics.substeps, events);
}

cl::FrameTiming Strands::frame() {
  follow_skin();
  const cl::FrameTiming timing = cl::timed_frame(queue_, [&](cl::PhaseEvents& events) {
    move(&events);
    chains_.write_keys(queue_, drawer_.keys(), &events);
    drawer_.enqueue(queue_, &events);
  });
  ++frames_;
  return timing;
}

cl::FrameTiming Strands::still() {
  chains_.write_keys(queue_, drawer_.keys());
  queue_.finish();
  return cl::timed_frame(queue_, [&](cl::PhaseEvents& events) { drawer_.enqueue(queue_, &events); });
}

bool Strands::set_view(std::shared_ptr<const StrandInput> input) {
  if (!drawer_.can_show(*input)) return false;
  drawer_.set_view(*input);
  input_ = std::move(input);
  return true;
}

void Strands::advance(int frames) {
  for (int i = 0; i < frames; ++i, ++frames_) {
    follow_skin();
    move(nullptr);
  }
  queue_.finish();
}

long Strands::substep() {
  const long index = chains_.steps();
  // This substep is the first half of the last frame's motion once more. The next frame begins where the last
  // one ended.
  if (skin_) chains_.set_skin(queue_, before_, skin_->frame(), 2);
  use_forces();
  chains_.enqueue(queue_, 1);
  queue_.finish();
  return index;
}

std::optional<std::pair<SkinFrame, SkinFrame>> Strands::skin_frames() const {
  if (!skin_) return {};
  return std::pair(before_, skin_->frame());
}

std::vector<KeyStrand> Strands::keys() {
  return keys_of(drawer_.keys().read(queue_), input_->fur.keys.size());
}

std::vector<const cl::Program*> Strands::programs() const {
  std::vector<const cl::Program*> all = chains_.programs();
  for (const cl::Program* program : drawer_.programs()) all.push_back(program);
  return all;
}

}  // namespace pelage::strands
