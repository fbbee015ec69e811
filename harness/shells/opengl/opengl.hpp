// The paper's own pipeline as a rival: OpenGL, N passes over the mesh with a vertex and a fragment shader (S
// 4), on whatever EGL finds: Mesa's llvmpipe on the processor, or a GPU. docs/rival.md says what it does and
// does not do.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/picture/picture.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Ways to write the same pipeline; the defaults are the fastest on llvmpipe whose picture agrees.
struct OpenGlOptions {
  std::string draws = "instanced";   ///< all layers in one draw | "each": a draw per layer
  std::string vertices = "indexed";  ///< shared | "corners": three per triangle, each transformed
  std::string snap = "shader";  ///< to 1/256 pixel in the vertex shader | "driver": interpolation then is not
  std::string fur = "array";    ///< array of layers | "volume": a 3D texture, whose mip levels merge layers |
                                ///< "slices": a texture per layer, bound before its draw
  std::string texels =
      "half";  ///< fur and coat as halves | "float" | "byte": llvmpipe filters bytes in bytes
  std::string levels = "trilinear";  ///< by the driver | "two": two lookups, mixed in the shader
  std::string target = "rgba32f";    ///< | "rgba16f" | "rgba8": rounded after every layer, as in 2010
  std::string power = "whole";       ///< squarings where the exponent is a whole number | "pow"
  std::string constants = "baked";   ///< the scene's numbers compiled into the shaders | "uniform"
  bool operator==(const OpenGlOptions&) const = default;
};

/// "key=value,key=value", keys and values as above; what is not named keeps its default. Throws InputError.
OpenGlOptions opengl_options(const std::string& text);
/// All of them in that form.
std::string to_text(const OpenGlOptions& options);

/// A scene in OpenGL. Construction uploads and builds the shaders; bend() takes the strands of a moment;
/// frame() draws them into a picture that stays in OpenGL until read(). Throws InputError where there is no
/// EGL, no OpenGL 4.5 or no OpenGL in this build; DeviceError for what OpenGL refuses.
class OpenGl {
 public:
  /// `mask`: wetness.size^2 texels (c_u, c_v, r, rho), Algorithm 1's result.
  OpenGl(std::shared_ptr<const FrameInput> input, const std::vector<glm::vec4>& mask,
         const OpenGlOptions& options = {});
  ~OpenGl();
  OpenGl(OpenGl&&) noexcept;
  OpenGl& operator=(OpenGl&&) noexcept;

  /// Strand tips minus their roots, F, R: the vertices' mean is taken here, on the host.
  void bend(const std::vector<glm::vec3>& tips);
  /// One frame: the bent vertices' upload, base pass and all layers, up to glFinish. Wall time in ms.
  double frame();
  Picture read() const;     ///< the last frame's own buffer
  double build_ms() const;  ///< shaders compiled and linked; drivers go on at the first frame

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Who draws: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6". Throws InputError as
/// above.
std::string opengl_renderer();

/// 16 hex digits over the names and contents of the shaders. Throws InputError when there are none.
std::string shader_hash();

}  // namespace pelage
