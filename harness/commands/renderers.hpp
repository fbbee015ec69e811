// The pipelines with which `pelage render` and `pelage animate` draw pictures.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "harness/commands/commands.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/picture/picture.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// The options that choose and configure a pipeline.
struct RendererOptions {
  std::string pipeline = "shells", mapping, opengl, device;
  /// 8: the reference rounds its picture to 8 bits per channel after every layer. 32: it does not round.
  int bits = 32;
};

/// Adds the options --pipeline, --mapping, --opengl, --device and --reference-bits to the command.
void add_renderer_options(CLI::App& command, RendererOptions& options);

struct DrawnFrame {
  Picture image;
  /// Writes the dump of the frame to a file. The function reads data from the device when it is called, so
  /// call it before the renderer draws the next picture.
  std::function<void(const std::filesystem::path&)> dump;
  double ms = 0;  ///< wall time of the frame; 0 if the pipeline does not time it
};

/// Draws pictures with one pipeline.
class SceneRenderer {
 public:
  virtual ~SceneRenderer() = default;
  /// Draws the scene after dynamics.time seconds of motion from the fur at rest. The scene has no keyframes.
  /// A renderer may keep its state and continue it in the next call. The picture does not depend on this: it
  /// has the same bits as the picture of a new renderer.
  virtual DrawnFrame draw(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) = 0;
  /// Returns the names of the device and of its driver, or "" for pipelines that run on the host.
  virtual std::string device() const { return {}; }
};

struct Renderer {
  std::string_view name;  ///< value of the option --pipeline
  std::string_view what;  ///< description of the pipeline in --help, one line
  bool rounds;            ///< true: the pipeline accepts the option --reference-bits
  bool has_variants;      ///< true: the pipeline accepts the option --opengl
  /// Reads the options, opens the device and starts to build the programs for the scene. Throws InputError or
  /// DeviceError. The commands call this function before they prepare the mesh, which may take minutes, so
  /// that errors are reported at once.
  std::unique_ptr<SceneRenderer> (*open)(const RendererOptions&, const Scene&);
};

std::span<const Renderer> renderers();

/// Checks the options and opens the pipeline that they name. Throws InputError for an option that the
/// pipeline does not use.
std::unique_ptr<SceneRenderer> open_renderer(const RendererOptions& options, const Scene& scene);

/// Prints the name of the device and the time of its first frame, which has no warm-up, unless the pipeline
/// does not time frames.
void report_first_frame(const SceneRenderer& renderer, const DrawnFrame& frame);

}  // namespace pelage
