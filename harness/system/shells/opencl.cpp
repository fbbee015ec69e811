// Shells on an OpenCL device.
#include <fmt/format.h>

#include "harness/compare/checks.hpp"
#include "harness/compare/metrics.hpp"
#include "harness/prepare/moving_skin.hpp"
#include "harness/shells/opencl/program_texts.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/shells/backends.hpp"

namespace pelage::shells {
namespace {

class ShellsOnDevice : public OnDevice<FrameInput, Shells, ShellOptions> {
 public:
  ShellsOnDevice(const BackendOptions& options, const Scene& scene)
      : OnDevice(options, {options.mapping, options.tuning, 0, !options.few_pictures}, scene,
                 expected_programs) {}

  void load(const SystemInput& input) override {
    OnDevice::load(input);
    pictures_ = 0;
  }
  void prepare_frame() override { pipeline_->follow_skin(); }
  cl::FrameTiming frame() override {
    refine();
    return OnDevice::frame();
  }
  cl::FrameTiming still() override {
    refine();
    return OnDevice::still();
  }
  void dump(Hdf5File& file, const Scene& scene) override {
    shells::dump(file, *drawn(), scene,
                 {"", frames_simulated(), pipeline_->tips(), pipeline_->velocities(), pipeline_->mask(), {}});
  }

  void begin_checks() override {
    frames_before_ = frames_simulated();
    if (has_springs(input_->scene.dynamics)) sticks_before_ = pipeline_->tips();
  }
  std::vector<Check> checks(const Picture& timed, std::uint32_t seed) override {
    const bool springs = has_springs(input_->scene.dynamics);
    const WindowCheck result = check_against_reference(
        *drawn(), frames_simulated(), timed, seed, springs ? pipeline_->tips() : std::vector<glm::vec3>());
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
    const Shells::MaskTime mask = pipeline_->mask_time();
    row.metrics["wet_ms"] = {mask.all, "ms"};
    row.metrics["per_mask_ms"] = {mask.after_mask, "ms"};
    row.metrics["covered_fragments"] = {double(pipeline_->count()), "fragments"};
    row.metrics["wet_share"] = {wet_share(*input_->mesh, pipeline_->mask(), input_->scene.wetness.size), "1"};
    if (!input_->droplets.empty()) {
      row.metrics["blended_share"] = {reference::blended_share(*input_, frames_simulated()), "1"};
      const reference::Discards discards = reference::discards(*input_, frames_simulated());
      row.metrics["outside_share"] = {discards.outside, "1"};
      row.metrics["dry_share"] = {discards.dry, "1"};
    }
    if (has_springs(input_->scene.dynamics)) {
      const springs::SpringNetwork network = springs::network_of(*input_);
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
    const Tally tally = pipeline_->tally();
    return {double(tally.covered), double(tally.shaded), double(tally.blended)};
  }

  std::string title() const override { return fmt::format("shells on {}", device_.info().name); }

 private:
  /// Returns the input with the skin of the last frame.
  std::shared_ptr<const FrameInput> drawn() const { return with_skin(input_, frames_simulated() - 1); }
  /// A single picture costs less than the refinement.
  void refine() {
    if (!options_.refine && ++pictures_ == 2) pipeline_->refine();
  }

  int pictures_ = 0;  ///< number of pictures that the pipeline has drawn, up to 2
  Agreement agreement_, sample_;
  int frames_before_ = 0;                 ///< frames simulated before the first timed frame
  std::vector<glm::vec3> sticks_before_;  ///< tips of the sticks at this time, in mesh radii
};

}  // namespace

std::unique_ptr<Backend> open_opencl(const BackendOptions& options, const Scene& scene) {
  return std::make_unique<ShellsOnDevice>(options, scene);
}

}  // namespace pelage::shells
