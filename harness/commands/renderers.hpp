// The pipelines with which `pelage render` draws a picture.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "harness/mesh/mesh.hpp"
#include "harness/picture/picture.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// The options of `pelage render` that choose and configure a pipeline.
struct RendererOptions {
  std::string pipeline = "shells", mapping, opengl, device;
  /// 8: the reference rounds its picture to 8 bits per channel after every layer. 32: it does not round.
  int bits = 32;
};

/// A picture, and the function that writes the dump of its frame to a file. It reads the data of the dump
/// from the device when it is called.
struct DrawnFrame {
  Picture image;
  std::function<void(const std::filesystem::path&)> dump;
};

/// Draws the scene with its mesh.
using DrawPicture = std::function<DrawnFrame(const std::shared_ptr<const Mesh>&)>;

struct Renderer {
  std::string_view name;  ///< value of the option --pipeline
  std::string_view what;  ///< description of the pipeline in --help, one line
  bool rounds;            ///< true: the pipeline accepts the option --reference-bits
  bool has_variants;      ///< true: the pipeline accepts the option --opengl
  /// Reads the options, opens the device and starts to build the programs. Throws InputError or DeviceError.
  /// `pelage render` calls this function before it prepares the mesh, which may take minutes, so that errors
  /// are reported at once.
  DrawPicture (*open)(const RendererOptions&, const Scene&);
};

std::span<const Renderer> renderers();

/// Checks the options and opens the pipeline that they name. Throws InputError for an option that the
/// pipeline does not use.
DrawPicture open_renderer(const RendererOptions& options, const Scene& scene);

}  // namespace pelage
