#include "harness/strands/opencl/strands.hpp"

#include <fmt/format.h>

#include "harness/cl/mapping_names.hpp"
#include "harness/error.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "harness/strands/scene/skin_frames.hpp"

namespace pelage::strands {
namespace {

DrawingScene drawing_of(const StrandInput& input) {
  DrawingScene scene;
  scene.camera = input.camera;
  scene.look = input.look;
  scene.range = input.range;
  scene.first_segment = input.dynamics.first_segment;
  scene.skin = input.skin;
  return scene;
}

}  // namespace

Drawing drawing_named(const std::string& name) {
  if (name.empty()) return Drawing::standard;
  if (name == cl::item_mapping) return Drawing::item;
  if (name == cl::group_mapping) return Drawing::group;
  throw InputError(fmt::format("mapping {}: strands have the mappings {} and {}", name, cl::item_mapping,
                               cl::group_mapping));
}

struct Strands::State {
  cl::Queue queue;
  std::shared_ptr<const StrandInput> input;
  Chains chains;
  Drawer drawer;
  std::optional<SkinFrames> skin;  ///< empty if the mesh does not deform
  SkinFrame before;                ///< the skin at the beginning of the last frame
  bool followed = false;           ///< the skin of the next frame is on the device
  int frames = 0;

  State(const cl::Device& device, std::shared_ptr<const StrandInput> from, const DrawerOptions& options)
      : queue(device),
        input(std::move(from)),
        chains(queue, input->fur.chains, input->dynamics),
        drawer(queue, drawing_of(*input), input->fur.strands, input->fur.keys.size(), options) {
    if (input->mesh->frames.empty()) return;
    skin.emplace(input->scene, input->mesh, input->fur, input->skin);
    skin->advance();
    before = skin->frame();
  }

  void follow_skin() {
    if (!skin || followed) return;
    before = skin->frame();
    skin->advance();
    chains.set_skin(queue, before, skin->frame(), input->scene.dynamics.substeps);
    if (skin->surface()) drawer.deform_skin(queue, *skin->surface());
    queue.finish();
    followed = true;
  }

  void move(cl::PhaseEvents* events) {
    followed = false;
    std::vector<cl::Event> launches;
    chains.enqueue(queue, input->scene.dynamics.substeps, events ? &launches : nullptr);
    for (cl::Event& event : launches) events->emplace_back("simulate", std::move(event));
  }

  void draw(cl::PhaseEvents* events) {
    std::vector<cl::Event> launches;
    chains.write_keys(queue, drawer.keys(), events ? &launches : nullptr);
    for (cl::Event& event : launches) events->emplace_back("keys", std::move(event));
    drawer.enqueue(queue, events);
  }
};

Strands::Strands(const cl::Device& device, std::shared_ptr<const StrandInput> input,
                 const DrawerOptions& options)
    : state_(std::make_unique<State>(device, std::move(input), options)) {}
Strands::~Strands() = default;
Strands::Strands(Strands&&) noexcept = default;
Strands& Strands::operator=(Strands&&) noexcept = default;

cl::FrameTiming Strands::frame() {
  State& s = *state_;
  s.follow_skin();
  const cl::FrameTiming timing = cl::timed_frame(s.queue, [&](cl::PhaseEvents& events) {
    s.move(&events);
    s.draw(&events);
  });
  ++s.frames;
  return timing;
}

cl::FrameTiming Strands::still() {
  State& s = *state_;
  s.chains.write_keys(s.queue, s.drawer.keys());
  s.queue.finish();
  return cl::timed_frame(s.queue, [&](cl::PhaseEvents& events) { s.drawer.enqueue(s.queue, &events); });
}

bool Strands::set_view(std::shared_ptr<const StrandInput> input) {
  State& s = *state_;
  const DrawingScene scene = drawing_of(*input);
  if (!s.drawer.can_show(scene)) return false;
  s.drawer.set_view(scene);
  s.input = std::move(input);
  return true;
}

void Strands::advance(int frames) {
  State& s = *state_;
  for (int i = 0; i < frames; ++i, ++s.frames) {
    s.follow_skin();
    s.move(nullptr);
  }
  s.queue.finish();
}

Picture Strands::read() const {
  return state_->drawer.read(state_->queue);
}
int Strands::frames_simulated() const {
  return state_->frames;
}
std::vector<ChainState> Strands::states() const {
  return state_->chains.states(state_->queue);
}
long Strands::substep() {
  const long index = state_->chains.steps();
  // This substep is the first half of the last frame's motion once more. The next frame begins where the last
  // one ended.
  if (const auto& skin = state_->skin)
    state_->chains.set_skin(state_->queue, state_->before, skin->frame(), 2);
  state_->chains.enqueue(state_->queue, 1);
  state_->queue.finish();
  return index;
}
std::optional<std::pair<SkinFrame, SkinFrame>> Strands::skin_frames() const {
  if (!state_->skin) return {};
  return std::pair(state_->before, state_->skin->frame());
}
void Strands::follow_skin() {
  state_->follow_skin();
}
std::shared_ptr<const SkinSurface> Strands::surface() const {
  return state_->skin ? state_->skin->surface() : state_->input->skin;
}
std::vector<KeyStrand> Strands::keys() const {
  return keys_of(state_->drawer.keys().read(state_->queue), state_->input->fur.keys.size());
}
std::vector<DrawnStrand> Strands::curves() {
  return state_->drawer.curves(state_->queue);
}
std::vector<Entry> Strands::order() const {
  return state_->drawer.order(state_->queue);
}

std::vector<const cl::Program*> Strands::programs() const {
  std::vector<const cl::Program*> all = state_->chains.programs();
  for (const cl::Program* program : state_->drawer.programs()) all.push_back(program);
  return all;
}

double Strands::build_ms() const {
  double sum = 0;
  for (const cl::Program* program : programs()) sum += program->build_ms();
  return sum;
}

}  // namespace pelage::strands
