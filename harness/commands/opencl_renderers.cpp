#include "harness/commands/opencl_renderers.hpp"

#include <fmt/format.h>

#include "harness/cl/build_ahead.hpp"
#include "harness/compare/frame_output.hpp"
#include "harness/compare/strands.hpp"
#include "harness/dump/dump.hpp"
#include "harness/dump/strands.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/scene/picture_scene.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/strands/opencl/program_texts.hpp"
#include "harness/strands/opencl/strands.hpp"

namespace pelage {
namespace {

std::string label_of(const cl::Device& device) {
  return fmt::format("{}, {} {}", device.info().name, device.info().platform, device.info().driver);
}

bool only_later(std::string_view key) {
  return key == "dynamics.time";
}

/// True if a simulation of `simulated` frames for the scene `from` can go on to the picture of the scene
/// `to`: the scenes differ only in their time and in keys for which `is_view` is true, and the picture shows
/// this frame or a later one.
bool continues(const Scene& from, const Scene& to, int simulated, bool (*is_view)(std::string_view)) {
  return frames_before(to.dynamics) + 1 >= simulated &&
         equal_except(from, to, [&](std::string_view key) { return only_later(key) || is_view(key); });
}

/// Simulates up to the picture of the scene, and draws this picture. Returns the frame's wall time in ms.
template <class Pipeline>
double draw_at(Pipeline& pipeline, const DynamicsScene& dynamics) {
  const int missing = frames_before(dynamics) + 1 - pipeline.frames_simulated();
  if (missing == 0) return pipeline.still().wall_ms;
  pipeline.advance(missing - 1);
  return pipeline.frame().wall_ms;
}

class ShellsRenderer : public SceneRenderer {
 public:
  explicit ShellsRenderer(const RendererOptions& options) : device_(cl::choose_device(options.device)) {
    options_.mapping = options.mapping;
  }
  std::string device() const override { return label_of(device_); }

  DrawnFrame draw(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) override {
    update(scene, mesh);
    DrawnFrame frame;
    frame.ms = draw_at(*shells_, scene.dynamics);
    frame.image = shells_->read();
    frame.dump = [input = input_, shells = shells_, scene, image = frame.image,
                  name = device_.info().name](const std::filesystem::path& path) {
      FrameInput dumped = *input;
      dumped.scene = scene;  // the scene of `input` may have another time
      dump_frame(path, dumped,
                 {fmt::format("shells on {}", name), shells->frames_simulated(), shells->tips(),
                  shells->velocities(), shells->mask(), image});
    };
    return frame;
  }

 private:
  /// Makes the state on the device that of `scene`, except for the simulation. This is the place for every
  /// part of the state that a picture needs anew although its scene differs from that of the last picture
  /// only in the time or in view keys.
  void update(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) {
    if (!shells_ || input_->mesh != mesh ||
        !continues(input_->scene, scene, shells_->frames_simulated(), is_view_key)) {
      shells_.reset();  // frees the device's memory first
      input_ = prepare(scene, mesh);
      shells_ = std::make_shared<Shells>(device_, input_, options_);
      points_.clear();
    } else if (!equal_except(input_->scene, scene, only_later)) {
      if (points_.empty()) points_ = framed_points(*input_);
      input_ = with_view(*input_, scene, points_);
      shells_->set_view(input_);
    }
  }

  cl::Device device_;
  ShellOptions options_;
  std::shared_ptr<const FrameInput> input_;
  std::shared_ptr<Shells> shells_;
  std::vector<glm::vec3> points_;  ///< framed_points() of input_, or empty
};

class StrandsRenderer : public SceneRenderer {
 public:
  StrandsRenderer(const RendererOptions& options, const Scene& scene)
      : device_(cl::choose_device(options.device)) {
    options_.mapping = strands::drawing_named(options.mapping);
    ahead_ = std::make_unique<cl::BuildAhead>(device_, strands::expected_programs(device_, scene, options_));
  }
  std::string device() const override { return label_of(device_); }

  DrawnFrame draw(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) override {
    update(scene, mesh);
    DrawnFrame frame;
    frame.ms = draw_at(*strands_, scene.dynamics);
    frame.image = strands_->read();
    frame.dump = [input = input_, drawn = strands_, scene, image = frame.image,
                  name = device_.info().name](const std::filesystem::path& path) {
      strands::StrandInput dumped = *input;
      dumped.scene = scene;  // the scene of `input` may have another time
      StrandFrame arrays{drawn->keys(), {}, drawn->order(), image};
      arrays.curves = drawn->curves();
      arrays.skin = drawn->surface();
      dump_strands(path, dumped, arrays, fmt::format("strands on {}", name), drawn->frames_simulated());
    };
    return frame;
  }

 private:
  /// Makes the state on the device that of `scene`, except for the simulation (ShellsRenderer::update()).
  void update(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) {
    if (strands_ && input_->mesh == mesh &&
        continues(input_->scene, scene, strands_->frames_simulated(), strands::is_view_key)) {
      if (equal_except(input_->scene, scene, only_later)) return;
      const auto changed = strands::with_view(*input_, scene);
      if (strands_->set_view(changed)) {
        input_ = changed;
        return;
      }
    }
    strands_.reset();
    input_ = strands::prepare_strands(scene, mesh);
    strands_ = std::make_shared<strands::Strands>(device_, input_, options_);
  }

  cl::Device device_;
  strands::DrawerOptions options_;
  std::unique_ptr<cl::BuildAhead> ahead_;
  std::shared_ptr<const strands::StrandInput> input_;
  std::shared_ptr<strands::Strands> strands_;
};

}  // namespace

std::unique_ptr<SceneRenderer> open_shells(const RendererOptions& options, const Scene&) {
  return std::make_unique<ShellsRenderer>(options);
}

std::unique_ptr<SceneRenderer> open_strands(const RendererOptions& options, const Scene& scene) {
  return std::make_unique<StrandsRenderer>(options, scene);
}

}  // namespace pelage
