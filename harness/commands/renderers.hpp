// The pipelines with which `pelage render` draws a picture.
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "harness/compare/frame_output.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// The options of `pelage render` that choose and configure a pipeline.
struct RendererOptions {
  std::string pipeline = "shells", mapping, opengl, device;
  int bits = 32;  ///< 8: the picture is rounded to 8 bits after every layer
};

using DrawPicture = std::function<FrameOutput(const std::shared_ptr<const FrameInput>&)>;

struct Renderer {
  std::string_view name;  ///< as users write it: --pipeline
  std::string_view what;  ///< one line for --help
  bool rounds;            ///< reads --reference-bits
  bool has_variants;      ///< reads --opengl
  /// Reads the options and finds the device. Throws InputError or DeviceError. Fast: it runs before the mesh
  /// is prepared, which may take minutes.
  DrawPicture (*open)(const RendererOptions&);
};

std::span<const Renderer> renderers();

/// Checks the options and opens the pipeline that they name. Throws InputError for an option that this
/// pipeline does not read.
DrawPicture open_renderer(const RendererOptions& options);

}  // namespace pelage
