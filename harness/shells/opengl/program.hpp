// The scene as GLSL: constants, the table of layers, compiled programs.
#pragma once
#include <epoxy/gl.h>

#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opengl/opengl.hpp"

namespace pelage::rivals {

/// A number of the scene that the shaders read: 1 to 4 floats.
struct Constant {
  std::string name;
  std::vector<float> value;
};

std::vector<Constant> scene_constants(const FrameInput& input);

/// What selects text in the shaders: "#define" lines. `wet`: some texel of the mask is.
std::string scene_defines(const FrameInput& input, const OpenGlOptions& options, bool wet);

/// Three rows per layer: bend, step, look (shaders/layers.glsl).
std::vector<glm::vec4> layer_table(const Scene& scene);

/// One linked program; move-only.
class Program {
 public:
  Program() = default;
  /// From `vertex` and `fragment` of the shader folder; both get `defines` and `constants`, the latter as
  /// literals or as uniforms. Throws DeviceError with OpenGL's log.
  Program(const std::string& vertex, const std::string& fragment, const std::string& defines,
          const std::vector<Constant>& constants, bool baked);
  ~Program();
  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;
  void use() const;
  GLint place(const char* uniform) const;  ///< -1 where the program has none

 private:
  GLuint id_ = 0;
};

}  // namespace pelage::rivals
