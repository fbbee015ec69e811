#include <fmt/format.h>

#include <chrono>

#include "harness/compare/checks.hpp"
#include "harness/compare/frame_output.hpp"
#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/opencl/simulate_stage.hpp"
#include "harness/shells/opencl/wet_stage.hpp"
#include "harness/shells/reference/strands.hpp"
#include "harness/tuning/tuning_search.hpp"

namespace pelage {
namespace {

template <class Work>
double timed(const Work& work) {
  const auto from = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
}

std::string broken(const std::vector<Check>& checks) {
  for (const Check& c : checks)
    if (!c.holds())
      return fmt::format("{} against {} is {:.6g}, but must be {} {:.6g}", c.metric, c.against, c.value,
                         c.at_least ? "at least" : "at most", c.limit);
  return {};
}

class Frame : public Contender {
 public:
  Frame(const cl::Device& device, std::shared_ptr<const FrameInput> input, const Tuning& tuning)
      : input_(std::move(input)), shells_(device, input_, {"", tuning}) {
    shells_.advance(frames_before(input_->scene.dynamics));
  }
  double run_ms() override { return shells_.frame().wall_ms; }
  std::string kernel_hash() const override { return shells_.kernel_hash(); }
  std::uint64_t output_hash() override { return Hash().values(shells_.read().pixel).value(); }
  std::string fault() override {
    return broken(check_against_reference(*input_, shells_.frames_simulated(), shells_.read(), 1).checks);
  }

 private:
  std::shared_ptr<const FrameInput> input_;
  Shells shells_;
};

class StrandStep : public Contender {
 public:
  StrandStep(const cl::Device& device, std::shared_ptr<const FrameInput> input, const Tuning& tuning)
      : queue_(device),
        input_(std::move(input)),
        stage_(queue_, *input_, shells::lay_out(*input_, device.info().lanes), device.info().lanes, tuning) {}
  std::string kernel_hash() const override { return cl::hash_of({&stage_.program()}); }
  double run_ms() override {
    return timed([&] {
      stage_.frame(queue_, frames_++, nullptr);
      queue_.finish();
    });
  }
  std::uint64_t output_hash() override { return Hash().values(stage_.state().read(queue_)).value(); }
  std::string fault() override {
    const std::vector<float> state = stage_.state().read(queue_);
    const auto stride = std::size_t(stage_.stride());
    std::vector<glm::vec3> ours, theirs;
    for (const reference::Strand& strand : reference::simulate(*input_, frames_)) {
      const std::size_t f = theirs.size();
      ours.emplace_back(state[TIP_X * stride + f], state[TIP_Y * stride + f], state[TIP_Z * stride + f]);
      theirs.emplace_back(strand.tip);
    }
    return broken({check_usual_tip(tip_errors(double(input_->scene.fur.length), ours, theirs))});
  }

 private:
  cl::Queue queue_;
  std::shared_ptr<const FrameInput> input_;
  shells::SimulateStage stage_;
  int frames_ = 0;
};

class Mask : public Contender {
 public:
  Mask(const cl::Device& device, std::shared_ptr<const FrameInput> input, const Tuning& tuning)
      : queue_(device), input_(std::move(input)), stage_(queue_, *input_, tuning) {}
  std::string kernel_hash() const override {
    return stage_.program() ? cl::hash_of({stage_.program()}) : std::string();
  }
  double run_ms() override {
    return timed([&] {
      const cl::Event event = stage_.run(queue_);
      queue_.finish();
    });
  }
  std::uint64_t output_hash() override { return Hash().values(stage_.mask().read(queue_)).value(); }
  std::string fault() override {
    const int frames = frames_before(input_->scene.dynamics) + 1;
    return broken(check_mask(stage_.mask().read(queue_), reference_mask(*input_, frames)));
  }

 private:
  cl::Queue queue_;
  std::shared_ptr<const FrameInput> input_;
  shells::WetStage stage_;
};

}  // namespace

TuningScene tuning_scene(const std::string& stage, const std::string& name, const cl::Device& device,
                         const std::shared_ptr<const FrameInput>& input) {
  if (stage == "rasterize")
    return {name, [=](const Tuning& t) { return std::make_unique<Frame>(device, input, t); }};
  if (stage == "simulate")
    return {name, [=](const Tuning& t) { return std::make_unique<StrandStep>(device, input, t); }};
  if (stage == "wet")
    return {name, [=](const Tuning& t) { return std::make_unique<Mask>(device, input, t); }};
  throw InputError(fmt::format(
      "stage '{}' cannot be timed alone; the stages that can be timed alone are rasterize, simulate and wet",
      stage));
}

}  // namespace pelage
