#include "harness/subjects/opengl.hpp"

#include "harness/compare/pictures.hpp"
#include "harness/compare/shares.hpp"
#include "harness/compare/windows.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/parallel.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/water.hpp"
#include "harness/record/part_hashes.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/opengl/opengl.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/strands.hpp"
#include "harness/subjects/with_opengl.hpp"

namespace pelage {
namespace {

std::vector<glm::vec4> mask_of(const FrameInput& input, int frames) {
  std::vector<glm::vec4> mask;
  for (const reference::Clump& texel : reference::wetness_mask(input, frames).texel)
    mask.emplace_back(texel.centre.x, texel.centre.y, texel.radius, texel.wetness);
  return mask;
}

class OpenGlSubject : public Subject {
 public:
  OpenGlSubject(std::shared_ptr<const FrameInput> input, const OpenGlOptions& options, std::uint32_t seed)
      : input_(std::move(input)),
        options_(options),
        seed_(seed),
        mask_(mask_of(*input_, frames_before(input_->scene.dynamics) + 1)),
        strands_(reference::simulate(*input_, 0)),
        opengl_(input_, mask_, options_) {
    advance(frames_before(input_->scene.dynamics));
  }

  /// Draws a frame. The returned time contains neither the simulation of the strands nor the computation of
  /// the wetness mask.
  FrameSample frame() override {
    advance(1);
    if (water_changes(input_->scene.wetness, input_->droplets)) {
      mask_ = mask_of(*input_, frames_);
      opengl_.set_mask(mask_);
    }
    std::vector<glm::vec3> tips;
    tips.reserve(strands_.size());
    for (const reference::Strand& strand : strands_) tips.emplace_back(strand.tip);
    opengl_.bend(tips, frames_);
    FrameSample sample;
    sample.cpu_ms = cost_of([&] { sample.wall_ms = opengl_.frame(); }).cpu_ms;
    return sample;
  }
  Picture read() override { return opengl_.read(); }
  std::vector<Check> check(const Picture& timed) override {
    const WindowCheck result = check_against_reference(*input_, frames_, timed, seed_);
    std::vector<Check> checks{result.windows};
    for (Check& check : other_filter_checks(against_reference, result.agreement))
      checks.push_back(std::move(check));
    return checks;
  }
  void describe(Row& row) override {
    row.build_ms = opengl_.build_ms();
    row.metrics["triangles"] = {double(input_->mesh->triangle.size()), "triangles"};
    row.metrics["model_height"] = {model_height(opengl_.read()), "1"};
    row.metrics["wet_share"] = {wet_share(*input_->mesh, mask_, input_->scene.wetness.size), "1"};
    row.metrics["frames_simulated"] = {double(frames_), "frames"};
    row.provenance["mesh_hash"] = input_->mesh->hash;
    row.provenance["mesh_warnings"] = uv_warnings(*input_->mesh);
    row.provenance["scene_hash"] = scene_hash(input_->scene);
    row.provenance["check_seed"] = seed_;
    const std::string renderer = opengl_renderer();
    row.provenance["opengl_renderer"] = renderer;
    row.identity[renderer_part] = renderer_hash(renderer);
    row.provenance["opengl_options"] = to_text(options_);
    row.provenance["shader_hash"] = row.identity[shader_part] = shader_hash();
  }

 private:
  void advance(int frames) {
    const std::size_t substeps = std::size_t(frames) * std::size_t(input_->scene.dynamics.substeps);
    const std::size_t first = std::size_t(frames_) * std::size_t(input_->scene.dynamics.substeps);
    for_each_index(strands_.size(), 256, [&](std::size_t face) {
      for (std::size_t i = 0; i < substeps; ++i)
        strands_[face] = reference::substep(*input_, face, strands_[face], first + i);
    });
    frames_ += frames;
  }

  std::shared_ptr<const FrameInput> input_;
  OpenGlOptions options_;
  std::uint32_t seed_;
  std::vector<glm::vec4> mask_;
  std::vector<reference::Strand> strands_;
  int frames_ = 0;
  OpenGl opengl_;
};

}  // namespace

std::unique_ptr<Subject> make_opengl(SubjectContext& context, const Case& which) {
  need_opengl();
  const OpenGlOptions options = opengl_options(which.opengl);
  const Scene scene = scene_of(context.experiment, which);
  return std::make_unique<OpenGlSubject>(prepare(scene, context.mesh_of(scene)), options,
                                         check_seed(which.name));
}

}  // namespace pelage
