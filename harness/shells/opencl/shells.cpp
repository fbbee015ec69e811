#include "harness/shells/opencl/shells.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "harness/prepare/moving_skin.hpp"
#include "harness/shells/opencl/raster_stage.hpp"
#include "harness/shells/opencl/simulate_stage.hpp"

namespace pelage {

struct Shells::State {
  cl::Queue queue;
  std::shared_ptr<const FrameInput> input;
  int lanes;
  shells::Geometry geometry;
  std::optional<shells::SimulateStage> simulate;  // Silva's strands
  std::optional<shells::SpringStage> springs;     // or a topology
  shells::WetStage wet;
  shells::RasterStage raster;
  int frames = 0;
  int followed = -1,
      shown = -1;  // numbers of the frames on whose skins the sticks stand and the layers are drawn

  State(const cl::Device& device, std::shared_ptr<const FrameInput> from, const ShellOptions& options)
      : queue(device),
        input(std::move(from)),
        lanes(shells::mapping_for(input->scene.blend, options.mapping, device.info()).lanes(device.info())),
        geometry(shells::lay_out(*input, lanes)),
        wet(queue, *input, options.tuning),
        raster(queue, *input, geometry, wet, options) {
    if (has_springs(input->scene.dynamics))
      springs.emplace(queue, input, geometry, lanes);
    else
      simulate.emplace(queue, *input, geometry, lanes, options.tuning);
    raster.collide_with(springs ? springs->contact() : simulate->contact());
  }

  /// Places the sticks on the skin of frame number `number`, if the skin deforms.
  void follow_skin(int number) {
    if (input->mesh->frames.empty() || followed == number) return;
    springs->follow_skin(queue, number);
    followed = number;
  }

  /// Draws the following pictures on the skin of frame number `number`, if the skin deforms.
  void show_skin(int number) {
    if (input->mesh->frames.empty() || shown == number) return;
    raster.set_skin(queue, shells::lay_out(skin_of_frame(*input, number), lanes));
    queue.finish();
    shown = number;
  }

  /// Computes the mask of the picture after `shown` frames, if the water changes over time.
  void wet_mask(int shown, cl::PhaseEvents* events) {
    if (!wet.changes()) return;
    wet.upload_droplets(queue, *input, shown);
    events->emplace_back("wet", wet.run(queue));
    raster.use_mask(queue, events);
  }

  void move(cl::PhaseEvents* events) {
    if (springs)
      springs->frame(queue, frames, events);
    else
      simulate->frame(queue, frames, events);
  }

  void draw(cl::PhaseEvents* events) {
    const cl::Buffer<float>& tips =
        springs ? springs->tips(queue, raster.params(), raster.vertex(), events)
                : raster.strand_tips(queue, simulate->state(), simulate->stride(), events);
    raster.frame(queue, tips, events);
  }

  /// Returns three columns of the state of Silva's strands.
  std::vector<glm::vec3> columns(std::size_t x, std::size_t y, std::size_t z) const {
    const std::vector<float> values = simulate->state().read(queue);
    const auto stride = std::size_t(simulate->stride());
    std::vector<glm::vec3> vectors(input->strands.root.size());
    for (std::size_t f = 0; f < vectors.size(); ++f)
      vectors[f] = {values[x * stride + f], values[y * stride + f], values[z * stride + f]};
    return vectors;
  }

  std::vector<const cl::Program*> programs() const {
    std::vector<const cl::Program*> all = raster.programs();
    if (springs)
      for (const cl::Program* program : springs->programs()) all.push_back(program);
    else
      all.push_back(&simulate->program());
    if (wet.program()) all.push_back(wet.program());
    return all;
  }
};

Shells::Shells(const cl::Device& device, std::shared_ptr<const FrameInput> input, const ShellOptions& options)
    : state_(std::make_unique<State>(device, std::move(input), options)) {}
Shells::~Shells() = default;
Shells::Shells(Shells&&) noexcept = default;
Shells& Shells::operator=(Shells&&) noexcept = default;

void Shells::follow_skin() {
  state_->follow_skin(state_->frames);
  state_->show_skin(state_->frames);
}

cl::FrameTiming Shells::frame() {
  State& s = *state_;
  follow_skin();
  const cl::FrameTiming timing = cl::timed_frame(s.queue, [&](cl::PhaseEvents& events) {
    s.wet_mask(s.frames + 1, &events);
    s.move(&events);
    s.draw(&events);
  });
  ++s.frames;
  if (s.springs) s.springs->check(s.queue);
  return timing;
}

void Shells::advance(int frames) {
  State& s = *state_;
  for (int i = 0; i < frames; ++i, ++s.frames) {
    s.follow_skin(s.frames);
    s.move(nullptr);
  }
  s.queue.finish();
  if (s.springs) s.springs->check(s.queue);
}

cl::FrameTiming Shells::still() {
  State& s = *state_;
  s.show_skin(std::max(s.frames - 1, 0));
  return cl::timed_frame(s.queue, [&](cl::PhaseEvents& events) {
    s.wet_mask(s.frames, &events);
    s.draw(&events);
  });
}

bool is_view_key(std::string_view key) {
  if (key == "shading.self_shadow") return false;  // traced shadows need other programs and buffers
  return key.starts_with("camera.") || key.starts_with("shading.") || key == "image.background";
}

bool Shells::set_view(std::shared_ptr<const FrameInput> input) {
  State& s = *state_;
  if (!s.raster.set_view(s.queue.device(), *input, s.geometry)) return false;
  s.input = std::move(input);
  return true;
}

Picture Shells::read() const {
  return state_->raster.read(state_->queue);
}
int Shells::frames_simulated() const {
  return state_->frames;
}
std::uint64_t Shells::count() {
  return state_->raster.count(state_->queue);
}
Tally Shells::tally(int every) {
  return state_->raster.tally(state_->queue, every);
}
void Shells::refine() {
  state_->raster.refine(state_->queue);
}
Shells::MaskTime Shells::mask_time() {
  State& s = *state_;
  if (s.input->droplets.empty()) return {};
  const auto since = [&](std::chrono::steady_clock::time_point begin) {
    s.queue.finish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  };
  s.queue.finish();
  const auto begin = std::chrono::steady_clock::now();
  const bool now = s.wet.changes() && s.frames > 0;
  s.wet.upload_droplets(s.queue, *s.input, now ? s.frames : frames_before(s.input->scene.dynamics) + 1);
  s.wet.run(s.queue);
  const double mask = since(begin);
  s.raster.use_mask(s.queue, nullptr);
  const double all = since(begin);
  return {all, all - mask};
}
double Shells::build_ms() const {
  double sum = 0;
  for (const cl::Program* program : state_->programs()) sum += program->build_ms();
  return sum;
}
std::vector<const cl::Program*> Shells::programs() const {
  return state_->programs();
}
std::string Shells::kernel_hash() const {
  return cl::hash_of(state_->programs());
}

std::vector<glm::vec4> Shells::mask() const {
  return state_->wet.mask().read(state_->queue);
}

std::vector<glm::vec3> Shells::tips() const {
  return state_->springs ? state_->springs->offsets(state_->queue) : state_->columns(TIP_X, TIP_Y, TIP_Z);
}

std::vector<glm::vec3> Shells::velocities() const {
  return state_->springs ? state_->springs->speeds(state_->queue)
                         : state_->columns(SPEED_X, SPEED_Y, SPEED_Z);
}

}  // namespace pelage
