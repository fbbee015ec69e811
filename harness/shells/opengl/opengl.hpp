// The OpenGL baseline. It is the pipeline of section 4 of S. This pipeline draws the mesh once per layer with
// a vertex shader and a fragment shader. It runs on a GPU, or on the CPU with Mesa's llvmpipe.
// docs/baselines.md describes the baseline.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Implementation choices of the baseline. With the defaults, the pictures agree with those of the reference
/// renderer. results/README.md compares the times of all choices.
struct OpenGlOptions {
  /// One draw call for all layers ("instanced"), or one per layer ("each").
  std::string draws = "instanced";
  /// Type of the fur texture: a 2D array ("array"), or a 3D texture whose mip levels merge neighbouring
  /// layers ("volume").
  std::string fur = "array";
  /// Texel format of the fur and coat textures: "half" or "byte". llvmpipe filters byte texels with 8-bit
  /// precision.
  std::string texels = "half";
  /// Framebuffer format: "rgba32f", "rgba16f" or "rgba8". With "rgba8" the picture is rounded to 8 bits after
  /// every layer, as on GPUs of 2010.
  std::string target = "rgba32f";
  /// The triangles that are drawn in a layer: "all", or only those that cover a pixel in front of the base
  /// surface ("seen"). The host finds the seen triangles before the frame, and the time of the frame does not
  /// contain this. It also sorts the triangles for blend.faces before the frame.
  std::string triangles = "all";
  /// The shader discards fragments that the fur does not cover ("yes"), or blends them ("no").
  std::string discard = "yes";
  bool operator==(const OpenGlOptions&) const = default;
};

/// Parses "key=value,key=value". The keys are the members of OpenGlOptions. Keys that are absent keep their
/// defaults. Throws InputError for an unknown key or value.
OpenGlOptions opengl_options(const std::string& text);
/// Returns all options in the form that opengl_options() reads.
std::string to_text(const OpenGlOptions& options);

/// A scene that OpenGL draws. The constructor uploads the scene and builds the shaders. It throws InputError
/// if EGL or OpenGL 4.5 is missing, if pelage was built without OpenGL, or if the baseline does not support
/// the scene. All members throw DeviceError if OpenGL reports an error.
class OpenGl {
 public:
  /// `mask` is the wetness mask (docs/shells.md, section 2) with wetness.size^2 texels. A texel holds the
  /// centre (c_u, c_v) and the radius r of a clump, and the wetness rho.
  OpenGl(std::shared_ptr<const FrameInput> input, const std::vector<glm::vec4>& mask,
         const OpenGlOptions& options = {});
  ~OpenGl();
  OpenGl(OpenGl&&) noexcept;
  OpenGl& operator=(OpenGl&&) noexcept;

  /// Bends the fur. For each vertex, the host computes the weighted mean of the tips of the strands around
  /// the vertex. `tips` has one entry per strand: the vector from the root to the tip. Its unit is the radius
  /// of the mesh's bounding sphere.
  /// bend() also moves the colliders of the scene to their places after `frames` frames of motion. With the
  /// option `triangles` "seen", bend() then finds the seen triangles. Therefore call set_mask() before
  /// bend().
  void bend(const std::vector<glm::vec3>& tips, int frames = 0);
  /// Changes the wetness mask. Only for scenes whose water changes over time (docs/shells.md, section 10).
  /// For each vertex, the host computes the axes of its curl.
  void set_mask(const std::vector<glm::vec4>& mask);
  /// Draws one frame: it uploads the bent vertices and a changed mask, draws the base surface and all layers,
  /// and calls glFinish. Returns the wall time in ms.
  double frame();
  Picture read() const;  ///< copies the picture of the last frame to the host
  /// Returns the time to compile and link the shaders, in ms. It does not include work that the driver
  /// postpones until the first draw call.
  double build_ms() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the renderer's name, for example "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa
/// 22.3.6". Throws InputError if there is no OpenGL.
std::string opengl_renderer();

/// Returns a hash of the names and the contents of the shader files as 16 hexadecimal digits. Throws
/// InputError if the folder of the shaders is missing.
std::string shader_hash();

}  // namespace pelage
