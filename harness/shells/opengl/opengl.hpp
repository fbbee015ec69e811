// The OpenGL baseline: the pipeline of the papers, with N passes over the mesh and a vertex and a fragment
// shader (S, section 4). It runs on a GPU, or on Mesa's llvmpipe, which is OpenGL on the CPU. docs/rival.md
// describes it.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Implementation choices of the baseline. The defaults are the fastest on llvmpipe whose picture agrees with
/// the reference.
struct OpenGlOptions {
  /// One draw call for all layers ("instanced"), or one per layer ("each").
  std::string draws = "instanced";
  /// Triangles share vertices ("indexed"), or each has three vertices of its own ("corners").
  std::string vertices = "indexed";
  /// The vertex shader rounds positions to 1/256 pixel ("shader"), or the driver does ("driver"). The driver
  /// rounds for coverage only and interpolates attributes from unrounded positions.
  std::string snap = "shader";
  /// Fur texture: a 2D array ("array"), a 3D texture, whose mip levels merge layers ("volume"), or a 2D
  /// texture per layer, bound before the layer's draw call ("slices").
  std::string fur = "array";
  /// Texel format of fur and coat: "half", "float" or "byte". llvmpipe filters bytes with 8-bit precision.
  std::string texels = "half";
  /// The driver mixes mip levels ("trilinear"), or the shader mixes two lookups ("two").
  std::string levels = "trilinear";
  /// Framebuffer format: "rgba32f", "rgba16f", or "rgba8", which rounds after every layer as in 2010.
  std::string target = "rgba32f";
  /// Powers by repeated squaring if the exponent is a whole number ("whole"), or always by pow() ("pow").
  std::string power = "whole";
  /// The scene's numbers are literals in the shader source ("baked"), or uniforms ("uniform").
  std::string constants = "baked";
  bool operator==(const OpenGlOptions&) const = default;
};

/// Parses "key=value,key=value" with the keys and values above. Keys that are absent keep their defaults.
/// Throws InputError for an unknown key or value.
OpenGlOptions opengl_options(const std::string& text);
/// Returns all options in the form that opengl_options() reads.
std::string to_text(const OpenGlOptions& options);

/// A scene in OpenGL. The constructor uploads the scene and builds the shaders. bend() sets the strands'
/// tips. frame() draws a picture, which stays in OpenGL until read(). Throws InputError if EGL, OpenGL 4.5 or
/// OpenGL in this build is missing, or if the scene is not supported. Throws DeviceError for errors of
/// OpenGL.
class OpenGl {
 public:
  /// `mask` is the result of Algorithm 1: wetness.size^2 texels (c_u, c_v, r, rho).
  OpenGl(std::shared_ptr<const FrameInput> input, const std::vector<glm::vec4>& mask,
         const OpenGlOptions& options = {});
  ~OpenGl();
  OpenGl(OpenGl&&) noexcept;
  OpenGl& operator=(OpenGl&&) noexcept;

  /// Bends the vertices: it computes the weighted mean of the strands' tips at each vertex, on the host.
  /// `tips` has one entry per strand: tip minus root, in R.
  void bend(const std::vector<glm::vec3>& tips);
  /// Draws one frame: it uploads the bent vertices, draws the base and all layers, and calls glFinish.
  /// Returns the wall time in ms.
  double frame();
  Picture read() const;     ///< reads the picture of the last frame back
  double build_ms() const;  ///< time to compile and link the shaders, without the driver's work at first use

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the renderer's name, e.g. "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa
/// 22.3.6". Throws InputError if there is no OpenGL.
std::string opengl_renderer();

/// Returns a hash of the names and the contents of the shaders, 16 hexadecimal digits. Throws InputError if
/// there are no shaders.
std::string shader_hash();

}  // namespace pelage
