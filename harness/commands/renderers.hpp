// The options of `pelage render`, `pelage animate` and `pelage diagram` that choose and configure a pipeline.
#pragma once
#include <memory>
#include <string>

#include "harness/commands/commands.hpp"
#include "harness/system/renderer.hpp"

namespace pelage {

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
