// Shells on an OpenCL device.
#include <fmt/format.h>

#include <optional>

#include "harness/cl/build_ahead.hpp"
#include "harness/compare/checks.hpp"
#include "harness/compare/shares.hpp"
#include "harness/compare/windows.hpp"
#include "harness/shells/opencl/program_texts.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/shells/backends.hpp"

namespace pelage::shells {
namespace {

class OnDevice : public Backend {
 public:
  OnDevice(const BackendOptions& options, const Scene& scene)
      : device_(*options.device), options_{options.mapping, options.tuning} {
    options_.refine = !options.few_pictures;
    if (options.few_pictures)
      ahead_ = std::make_unique<cl::BuildAhead>(device_, expected_programs(device_, scene, options_));
  }

  void load(const SystemInput& input) override {
    shells_.reset();  // frees the device's memory first
    input_ = own<FrameInput>(input);
    shells_.emplace(device_, input_, options_);
    pictures_ = 0;
  }
  bool set_view(const SystemInput& input) override {
    if (!shells_->set_view(own<FrameInput>(input))) return false;
    input_ = own<FrameInput>(input);
    return true;
  }
  cl::FrameTiming frame() override {
    refine();
    return timing_ = shells_->frame();
  }
  cl::FrameTiming still() override {
    refine();
    return shells_->still();
  }
  void advance(int frames) override { shells_->advance(frames); }
  int frames_simulated() const override { return shells_->frames_simulated(); }
  Picture read() override { return shells_->read(); }
  void dump(Hdf5File& file, const Scene& scene) override {
    shells::dump(file, *input_, scene,
                 {"", frames_simulated(), shells_->tips(), shells_->velocities(), shells_->mask(), {}});
  }

  void begin_checks() override {
    frames_before_ = frames_simulated();
    if (has_springs(input_->scene.dynamics)) sticks_before_ = shells_->tips();
  }
  std::vector<Check> checks(const Picture& timed, std::uint32_t seed) override {
    const bool springs = has_springs(input_->scene.dynamics);
    const WindowCheck result = check_against_reference(*input_, frames_simulated(), timed, seed,
                                                       springs ? shells_->tips() : std::vector<glm::vec3>());
    agreement_ = result.agreement;
    sample_ = result.sample;
    std::vector<Check> checks = result.checks;
    // check_against_reference() draws its reference picture from the mass positions that the device has
    // simulated, so it does not find errors of the simulation. Therefore check_sticks() also compares the
    // mass positions before the first timed frame with a double-precision simulation.
    if (springs)
      for (Check& check : check_sticks(*input_, frames_before_, sticks_before_))
        checks.push_back(std::move(check));
    return checks;
  }
  void describe(Description& row) override {
    row.tuning = options_.tuning;
    const Shells::MaskTime mask = shells_->mask_time();
    row.metrics["wet_ms"] = {mask.all, "ms"};
    row.metrics["per_mask_ms"] = {mask.after_mask, "ms"};
    row.metrics["covered_fragments"] = {double(shells_->count()), "fragments"};
    row.metrics["wet_share"] = {wet_share(*input_->mesh, shells_->mask(), input_->scene.wetness.size), "1"};
    if (!input_->droplets.empty())
      row.metrics["blended_share"] = {reference::blended_share(*input_, frames_simulated()), "1"};
    if (has_springs(input_->scene.dynamics)) {
      const springs::SpringNetwork network = springs::topology_of(*input_);
      row.metrics["masses"] = {double(network.mass.size()), "masses"};
      row.metrics["springs"] = {double(network.spring.size()), "springs"};
    }
    add_agreement(row, agreement_);
    // These metrics also help to find the cause of a failed check.
    row.metrics["windows_psnr"] = {sample_.psnr, "dB"};
    row.metrics["windows_flips"] = {double(sample_.flips), "pixels"};
    row.metrics["worst_x"] = {double(agreement_.worst_x), "pixels"};
    row.metrics["worst_y"] = {double(agreement_.worst_y), "pixels"};
  }
  std::size_t segments() const override {
    return input_->scene.dynamics.topology == "silva" ? input_->mesh->triangle.size() : 0;
  }
  BackendWork work() override {
    const Tally tally = shells_->tally();
    return {double(tally.covered), double(tally.shaded), double(tally.blended)};
  }

  std::string title() const override { return fmt::format("shells on {}", device_.info().name); }
  std::vector<const cl::Program*> programs() const override { return shells_->programs(); }
  std::string device() const override { return label_of(device_); }

 private:
  /// A single picture costs less than the refinement.
  void refine() {
    if (!options_.refine && ++pictures_ == 2) shells_->refine();
  }

  cl::Device device_;
  std::shared_ptr<const FrameInput> input_;
  ShellOptions options_;
  std::unique_ptr<cl::BuildAhead> ahead_;
  std::optional<Shells> shells_;
  int pictures_ = 0;        ///< number of pictures that shells_ has drawn, up to 2
  cl::FrameTiming timing_;  ///< of the last frame()
  Agreement agreement_, sample_;
  int frames_before_ = 0;                 ///< frames simulated before the first timed frame
  std::vector<glm::vec3> sticks_before_;  ///< tips of the sticks at this time, in mesh radii
};

}  // namespace

std::unique_ptr<Backend> open_opencl(const BackendOptions& options, const Scene& scene) {
  return std::make_unique<OnDevice>(options, scene);
}

}  // namespace pelage::shells
