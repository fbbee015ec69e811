#include "harness/subjects/shells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>

#include "harness/cl/program.hpp"
#include "harness/compare/shares.hpp"
#include "harness/compare/sticks.hpp"
#include "harness/compare/windows.hpp"
#include "harness/error.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/measure/memory.hpp"
#include "harness/measure/program_hashes.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/record/part_hashes.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/subjects/agreement_metrics.hpp"
#include "harness/subjects/simulation_times.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

class ShellsSubject : public Subject {
 public:
  ShellsSubject(const cl::Device& device, std::shared_ptr<const FrameInput> input,
                const ShellOptions& options, std::uint32_t seed)
      : input_(std::move(input)), options_(options), seed_(seed), shells_(device, input_, options) {
    bounded([&] { shells_.advance(frames_before(input_->scene.dynamics)); });
    if (has_springs(input_->scene.dynamics)) before_ = shells_.tips();
  }

  FrameSample frame() override {
    cl::FrameTiming timing;
    const Cost whole = cost_of([&] { bounded([&] { timing = shells_.frame(); }); });
    FrameSample sample{
        .wall_ms = timing.wall_ms, .phase_event_ms = timing.phase_event_ms, .cpu_ms = whole.cpu_ms};
    simulated_.add(sample);
    return sample;
  }
  Picture read() override { return shells_.read(); }
  std::vector<Check> check(const Picture& timed) override {
    peak_ = peak_memory();  // read before the reference allocates memory
    const bool springs = has_springs(input_->scene.dynamics);
    const WindowCheck result = check_against_reference(*input_, shells_.frames_simulated(), timed, seed_,
                                                       springs ? shells_.tips() : std::vector<glm::vec3>());
    agreement_ = result.agreement;
    sample_ = result.sample;
    std::vector<Check> checks = result.checks;
    // check_against_reference() draws its reference picture from the mass positions that the device has
    // simulated, so it does not find errors of the simulation. Therefore check_sticks() also compares the
    // mass positions before the first timed frame with a double-precision simulation.
    if (springs)
      for (Check& check : check_sticks(*input_, frames_before(input_->scene.dynamics), before_))
        checks.push_back(std::move(check));
    return checks;
  }
  void describe(Row& row) override {
    row.build_ms = shells_.build_ms();
    row.tuning = options_.tuning;
    row.metrics["wet_ms"] = {shells_.wet_ms(), "ms"};
    row.metrics["per_mask_ms"] = {shells_.per_mask_ms(), "ms"};
    row.metrics["covered_fragments"] = {double(shells_.count()), "fragments"};
    row.metrics["triangles"] = {double(input_->mesh->triangle.size()), "triangles"};
    row.metrics["model_height"] = {model_height(shells_.read()), "1"};
    row.metrics["wet_share"] = {wet_share(*input_->mesh, shells_.mask(), input_->scene.wetness.size), "1"};
    if (!input_->droplets.empty())
      row.metrics["blended_share"] = {reference::blended_share(*input_, shells_.frames_simulated()), "1"};
    if (peak_ > 0) row.metrics["peak_memory"] = {double(peak_), "bytes"};
    row.metrics["frames_simulated"] = {double(shells_.frames_simulated()), "frames"};
    if (has_springs(input_->scene.dynamics)) {
      const springs::SpringNetwork topology = springs::topology_of(*input_);
      row.metrics["masses"] = {double(topology.mass.size()), "masses"};
      row.metrics["springs"] = {double(topology.spring.size()), "springs"};
    }
    if (input_->scene.dynamics.topology == "silva") simulated_.describe(row, input_->mesh->triangle.size());
    add_agreement(row, agreement_);
    // These metrics also help to find the cause of a failed check.
    row.metrics["windows_psnr"] = {sample_.psnr, "dB"};
    row.metrics["windows_flips"] = {double(sample_.flips), "pixels"};
    row.metrics["worst_x"] = {double(agreement_.worst_x), "pixels"};
    row.metrics["worst_y"] = {double(agreement_.worst_y), "pixels"};
    add_programs(row.identity, shells_.programs());
    row.provenance["kernel_hash"] = shells_.kernel_hash();
    row.provenance["mesh_hash"] = input_->mesh->hash;
    row.provenance["mesh_warnings"] = uv_warnings(*input_->mesh);
    row.provenance["scene_hash"] = scene_hash(input_->scene);
    row.provenance["check_seed"] = seed_;
  }

 private:
  template <class F>
  static void bounded(F&& move) {
    try {
      move();
    } catch (const springs::Diverged& error) {
      throw OutOfBounds(error.what());
    }
  }

  std::shared_ptr<const FrameInput> input_;
  ShellOptions options_;
  std::uint32_t seed_;
  Agreement agreement_, sample_;
  std::uint64_t peak_ = 0;
  SimulationTimes simulated_;
  Shells shells_;
  std::vector<glm::vec3> before_;  ///< tips of the sticks before the first timed frame, in mesh radii
};

}  // namespace

std::unique_ptr<Subject> make_shells(SubjectContext& context, const Case& which) {
  const Scene scene = scene_of(context.experiment, which);
  const auto mesh = context.mesh_of(scene);
  const ShellOptions options{which.mapping, context.tuning};
  reset_peak_memory();
  return std::make_unique<ShellsSubject>(context.device, prepare(scene, mesh), options,
                                         check_seed(which.name));
}

}  // namespace pelage
