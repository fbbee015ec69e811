#include "harness/tuning/contenders.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/compare/windows.hpp"
#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/shells/opencl/params.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/opencl/simulate_stage.hpp"
#include "harness/shells/opencl/wet_stage.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/strands.hpp"

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
      return fmt::format("{} against {} is {:.6g}, must be {} {:.6g}", c.metric, c.against, c.value,
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

/// Of the strands' length: what pelage check allows the usual tip.
constexpr double usual_tip_error = 1e-5;

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
    const std::vector<float> ours = stage_.state().read(queue_);
    const auto stride = std::size_t(stage_.stride());
    const auto theirs = reference::simulate(*input_, frames_);
    std::size_t off = 0;
    for (std::size_t f = 0; f < theirs.size(); ++f) {
      const glm::dvec3 tip(ours[TIP_X * stride + f], ours[TIP_Y * stride + f], ours[TIP_Z * stride + f]);
      const double error = glm::length(tip - theirs[f].tip) / double(input_->scene.fur.length);
      off += !(error <= usual_tip_error);
    }
    if (off * 1000 <= theirs.size()) return {};
    return fmt::format("{} of {} tips are more than 1e-5 of a strand's length off", off, theirs.size());
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
    const std::vector<float> ours = stage_.mask().read(queue_);
    const auto theirs = reference::wetness_mask(*input_).texel;
    std::size_t off = 0;
    for (std::size_t i = 0; i < theirs.size(); ++i) {
      const reference::Clump& t = theirs[i];
      const double values[] = {t.centre.x, t.centre.y, t.radius, t.wetness};
      bool bad = false;
      for (std::size_t k = 0; k < 4; ++k)
        bad = bad || !(std::abs(double(ours[4 * i + k]) - values[k]) <= 1e-5);
      off += bad;
    }
    if (off == 0) return {};
    return fmt::format("{} of {} texels differ from the reference's", off, theirs.size());
  }

 private:
  cl::Queue queue_;
  std::shared_ptr<const FrameInput> input_;
  shells::WetStage stage_;
};

}  // namespace

TuningScene tuning_scene(const std::string& stage, const std::string& name, const cl::Device& device,
                         std::shared_ptr<const FrameInput> input) {
  if (stage == "rasterize")
    return {name, [=](const Tuning& t) { return std::make_unique<Frame>(device, input, t); }};
  if (stage == "simulate")
    return {name, [=](const Tuning& t) { return std::make_unique<StrandStep>(device, input, t); }};
  if (stage == "wet")
    return {name, [=](const Tuning& t) { return std::make_unique<Mask>(device, input, t); }};
  throw InputError(fmt::format("stage '{}' cannot be timed alone: rasterize, simulate, wet can", stage));
}

}  // namespace pelage
