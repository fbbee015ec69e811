// Shells by the OpenGL baseline (docs/baselines.md). The reference simulates the strands and the water.
#include "harness/shells/opengl/opengl.hpp"

#include <fmt/format.h>

#include <optional>

#include "harness/compare/checks.hpp"
#include "harness/compare/metrics.hpp"
#include "harness/parallel.hpp"
#include "harness/prepare/water.hpp"
#include "harness/shells/reference/strands.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/shells/backends.hpp"

namespace pelage::shells {
namespace {

class ShellsInOpenGl : public InOpenGl<FrameInput, OpenGlOptions> {
 public:
  using InOpenGl::InOpenGl;

  void load(const SystemInput& input) override {
    opengl_.reset();
    input_ = own<FrameInput>(input);
    frames_ = 0;
    prepared_ = false;
    mask_ = reference_mask(*input_, frames_before(input_->scene.dynamics) + 1);
    strands_ = reference::simulate(*input_, 0);
    opengl_.emplace(input_, mask_, options_);
  }

  cl::FrameTiming still() override { return {opengl_->frame(), {}, {}}; }
  void advance(int frames) override {
    const std::size_t substeps = std::size_t(frames) * std::size_t(input_->scene.dynamics.substeps);
    const std::size_t first = std::size_t(frames_) * std::size_t(input_->scene.dynamics.substeps);
    const reference::FrameForces forces(*input_, frames_, frames);
    for_each_index(strands_.size(), 256, [&](std::size_t face) {
      for (std::size_t i = 0; i < substeps; ++i)
        strands_[face] = reference::substep(*input_, forces, face, strands_[face], first + i);
    });
    frames_ += frames;
  }
  Picture read() override { return opengl_->read(); }
  void dump(Hdf5File& file, const Scene& scene) override {
    FrameOutput output{"", frames_, {}, {}, mask_, {}};
    for (const reference::Strand& strand : strands_) {
      output.tips.emplace_back(strand.tip);
      output.velocities.emplace_back(strand.velocity);
    }
    shells::dump(file, *input_, scene, output);
  }

  std::vector<Check> checks(const Picture& timed, std::uint32_t seed) override {
    const WindowCheck result = check_against_reference(*input_, frames_, timed, seed);
    std::vector<Check> checks{result.windows};
    for (Check& check : other_filter_checks(against_reference, result.agreement))
      checks.push_back(std::move(check));
    return checks;
  }
  void describe(Description& row) override {
    InOpenGl::describe(row);
    row.metrics["wet_share"] = {wet_share(*input_->mesh, mask_, input_->scene.wetness.size), "1"};
  }
  std::string title() const override { return fmt::format("opengl on {}, {}", renderer_, to_text(options_)); }
  double build_ms() const override { return opengl_->build_ms(); }

 private:
  /// Simulates the strands and the water.
  void simulate() override {
    advance(1);
    if (water_changes(input_->scene.wetness, input_->droplets)) {
      mask_ = reference_mask(*input_, frames_);
      opengl_->set_mask(mask_);
    }
    std::vector<glm::vec3> tips;
    tips.reserve(strands_.size());
    for (const reference::Strand& strand : strands_) tips.emplace_back(strand.tip);
    opengl_->bend(tips, frames_);
  }

  std::vector<glm::vec4> mask_;
  std::vector<reference::Strand> strands_;
  std::optional<OpenGl> opengl_;
};

}  // namespace

std::unique_ptr<Backend> open_opengl(const BackendOptions& options, const Scene&) {
  return std::make_unique<ShellsInOpenGl>(opengl_options(options.opengl));
}

}  // namespace pelage::shells
