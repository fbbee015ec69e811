// The command-line options that define a scene: a file, a model, overrides and a size.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/scene/scene.hpp"
#include "harness/system/renderer.hpp"

namespace pelage {

struct SceneOptions {
  /// Scene file, or name of an example; empty: the default scene. With `case_name`: an experiment.
  std::string file;
  std::string case_name;  ///< case of the experiment `file`, whose scene is used; empty: `file` is a scene
  std::string model;      ///< name of a model, or mesh file; empty: the model of the scene file
  std::string reading;    ///< reading of the paper: "paper", or "pelage" or "" for the scene as it is
  std::string up;         ///< value for the scene key mesh.up; empty: the value in the scene file
  std::string size;  ///< picture size "WxH" in pixels; empty: image.width and image.height of the scene file
  std::vector<std::string> set;  ///< overrides, key=value
};

/// Adds the positional argument SCENE and the options --case, --set, --model, --up and --reading to the
/// command. If `draws` is true, also adds the option --size.
void add_scene_options(CLI::App& command, SceneOptions& options, bool draws);

/// Adds the option --up, which sets the scene key mesh.up.
void add_up_option(CLI::App& command, std::string& up);

/// Adds the option --reading.
void add_reading_option(CLI::App& command, std::string& reading);

/// Returns the scene with all overrides. pipeline: the option --pipeline; the reading of the paper depends on
/// it. Throws InputError for unknown keys and values out of range.
Scene resolve_scene(const SceneOptions& options, std::string_view pipeline = {});

/// Returns the scene's mesh. Prints the steps of its preparation and the defects of its UV map to stderr.
std::shared_ptr<const Mesh> load_scene_mesh(const Scene& scene);

// The options of `pelage render`, `pelage animate` and `pelage diagram` that choose and configure a pipeline.

struct RendererOptions {
  std::string pipeline;  ///< "": the scene's key `pipeline`
  std::string mapping, opengl, device;
  /// 8: the reference rounds its picture to 8 bits per channel after every layer. 32: it does not round.
  int bits = 32;
  bool strict = false;  ///< warnings are errors
};

/// Adds the options --pipeline, --mapping, --opengl, --device, --reference-bits and --strict to the command.
void add_renderer_options(CLI::App& command, RendererOptions& options);

/// Returns the name of the pipeline that draws the scene.
const std::string& pipeline_of(const RendererOptions& options, const Scene& scene);

/// Checks the options and opens the pipeline. `shown` is the scene of the first picture; `scene` also has the
/// keyframes. Throws InputError for an option that the pipeline does not use. Prints a warning that names the
/// keys of the scene that the pipeline does not use. The commands call this function before they prepare the
/// mesh, which may take minutes, so that errors are reported at once.
std::unique_ptr<Renderer> open_renderer(const RendererOptions& options, const Scene& scene,
                                        const Scene& shown);

/// Returns the scene's mesh. Prints the steps of its preparation and the defects of its UV map to stderr.
/// Throws InputError for defects if warnings are errors.
std::shared_ptr<const Mesh> load_drawn_mesh(const RendererOptions& options, const Scene& scene);

}  // namespace pelage
