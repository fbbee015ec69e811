#include "harness/subjects/strands.hpp"

#include "harness/cl/program.hpp"
#include "harness/compare/pictures.hpp"
#include "harness/compare/shares.hpp"
#include "harness/compare/strands.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/measure/memory.hpp"
#include "harness/measure/program_hashes.hpp"
#include "harness/record/part_hashes.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/opengl/opengl.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "harness/strands/opengl/ribbon_options.hpp"
#include "harness/subjects/agreement_metrics.hpp"
#include "harness/subjects/simulation_times.hpp"
#include "harness/subjects/with_opengl.hpp"

namespace pelage {
namespace {

class StrandsSubject : public Subject {
 public:
  StrandsSubject(const cl::Device& device, std::shared_ptr<const strands::StrandInput> input,
                 const strands::DrawerOptions& options, bool still, std::uint32_t seed)
      : input_(std::move(input)), still_(still), seed_(seed), strands_(device, input_, options) {
    strands_.advance(frames_before(input_->scene.dynamics));
    step_.before = strands_.states();
    step_.number = strands_.substep();
    step_.after = strands_.states();
    step_.skin = strands_.skin_frames();
  }

  FrameSample frame() override {
    FrameSample sample;
    if (!still_) strands_.follow_skin();
    const Cost cost = cost_of([&] {
      const cl::FrameTiming timing = still_ ? strands_.still() : strands_.frame();
      sample.wall_ms = timing.wall_ms;
      sample.phase_event_ms = timing.phase_event_ms;
    });
    sample.cpu_ms = cost.cpu_ms;
    simulated_.add(sample);
    return sample;
  }
  Picture read() override { return strands_.read(); }
  /// Draws a picture and returns its key strands.
  std::vector<strands::KeyStrand> keys() {
    strands_.still();
    return strands_.keys();
  }
  std::vector<Check> check(const Picture& timed) override {
    peak_ = peak_memory();  // read before the reference allocates memory
    std::vector<Check> checks = check_chain_step(*input_, step_, seed_);
    StrandFrame frame{strands_.keys(), {}, strands_.order(), timed};
    frame.curves = strands_.curves();
    frame.skin = strands_.surface();
    drawn_ = frame.order.size();
    StrandCheck found = check_strand_frame(*input_, frame, seed_);
    agreement_ = found.agreement;
    fragments_ = found.fragments;
    for (Check& check : found.checks) checks.push_back(std::move(check));
    return checks;
  }
  void describe(Row& row) override {
    row.build_ms = strands_.build_ms();
    row.metrics["strands"] = {double(input_->fur.strands.size()), "strands"};
    row.metrics["key_strands"] = {double(input_->fur.keys.size()), "strands"};
    row.metrics["drawn_strands"] = {double(drawn_), "strands"};
    row.metrics["covered_fragments"] = {double(fragments_), "fragments"};
    row.metrics["triangles"] = {double(input_->mesh->triangle.size()), "triangles"};
    row.metrics["model_height"] = {model_height(strands_.read()), "1"};
    if (peak_ > 0) row.metrics["peak_memory"] = {double(peak_), "bytes"};
    row.metrics["frames_simulated"] = {double(strands_.frames_simulated()), "frames"};
    simulated_.describe(row, 2 * input_->fur.keys.size());
    add_agreement(row, agreement_);
    add_programs(row.identity, strands_.programs());
    row.provenance["kernel_hash"] = cl::hash_of(strands_.programs());
    row.provenance["mesh_hash"] = input_->mesh->hash;
    row.provenance["scene_hash"] = scene_hash(input_->scene);
    row.provenance["check_seed"] = seed_;
  }

 private:
  std::shared_ptr<const strands::StrandInput> input_;
  bool still_;  ///< true: the chains do not move
  std::uint32_t seed_;
  Agreement agreement_;
  std::size_t drawn_ = 0;
  std::uint64_t fragments_ = 0;
  std::uint64_t peak_ = 0;
  SimulationTimes simulated_;
  strands::Strands strands_;
  ChainStep step_;  ///< the time step before the first timed frame
};

/// The OpenGL baseline. It draws the key strands that the device has after the case's frames before the first
/// picture.
class RibbonsSubject : public Subject {
 public:
  RibbonsSubject(std::shared_ptr<const strands::StrandInput> input, std::vector<strands::KeyStrand> keys,
                 const strands::RibbonOptions& options)
      : input_(std::move(input)),
        keys_(std::move(keys)),
        options_(options),
        ribbons_({input_->camera, input_->look, input_->range, input_->dynamics.first_segment},
                 input_->fur.strands, options) {}

  FrameSample frame() override {
    FrameSample sample;
    sample.cpu_ms = cost_of([&] { sample.wall_ms = ribbons_.frame(keys_); }).cpu_ms;
    return sample;
  }
  Picture read() override { return ribbons_.read(); }
  std::vector<Check> check(const Picture& timed) override {
    return other_filter_checks(against_reference,
                               compare(timed, reference_strands(*input_, keys_, input_->skin).picture));
  }
  void describe(Row& row) override {
    const std::string renderer = opengl_renderer();
    row.provenance["opengl_renderer"] = renderer;
    row.identity[renderer_part] = renderer_hash(renderer);
    row.provenance["opengl_options"] = strands::to_text(options_);
    row.provenance["shader_hash"] = row.identity[shader_part] = shader_hash();
  }

 private:
  std::shared_ptr<const strands::StrandInput> input_;
  std::vector<strands::KeyStrand> keys_;
  strands::RibbonOptions options_;
  strands::Ribbons ribbons_;
};

/// Throws Unsupported if the OpenGL baseline cannot draw the scene.
void need_key_light_only(const strands::StrandInput& input) {
  const StrandsScene& s = input.scene.strands;
  if (!input.look.fills.empty() || s.rim != glm::vec3(0) || s.skin_shadow != 0 || s.shadow != "none" ||
      s.skin)
    throw Unsupported(
        "the OpenGL baseline draws strands with a key light and ambient light only: give one "
        "[[shading.light]], and set strands.skin_shadow = 0, strands.rim = [0, 0, 0], strands.shadow = "
        "\"none\", strands.skin = false");
}

std::unique_ptr<StrandsSubject> strands_subject(SubjectContext& context, const Case& which,
                                                std::shared_ptr<const strands::StrandInput> input,
                                                bool still) {
  strands::DrawerOptions options;
  options.mapping = strands::drawing_named(which.mapping);
  reset_peak_memory();
  return std::make_unique<StrandsSubject>(context.device, std::move(input), options, still,
                                          check_seed(which.name));
}

std::shared_ptr<const strands::StrandInput> input_of(SubjectContext& context, const Case& which) {
  const Scene scene = scene_of(context.experiment, which);
  return strands::prepare_strands(scene, context.mesh_of(scene));
}

}  // namespace

std::unique_ptr<Subject> make_strand_frames(SubjectContext& context, const Case& which) {
  return strands_subject(context, which, input_of(context, which), false);
}

std::unique_ptr<Subject> make_strands_against_opengl(SubjectContext& context, const Case& which) {
  need_opengl();
  const strands::RibbonOptions options = strands::ribbon_options(which.opengl);
  const auto input = input_of(context, which);
  need_key_light_only(*input);
  auto ours = strands_subject(context, which, input, true);
  auto theirs = std::make_unique<RibbonsSubject>(input, ours->keys(), options);
  return with_opengl(std::move(ours), std::move(theirs));
}

}  // namespace pelage
