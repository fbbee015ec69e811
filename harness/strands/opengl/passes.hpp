// The passes of the OpenGL baseline of strands: strips of strands, the opacity map, and the skin. An OpenGL
// context must be current.
#pragma once
#include <memory>
#include <vector>

#include "harness/gl/program.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/opengl/host_strands.hpp"

namespace pelage::strands {

/// The strips of up to `strands` strands. With the program of shaders.hpp, draw() uploads and draws them.
class Strips {
 public:
  /// `lights`: has_lights() of the look. `shapes`: the strands have shapes.
  Strips(std::size_t strands, int segments, bool instanced, bool lights, bool shapes);
  void draw(const Records& records) const;

 private:
  int segments_;
  bool instanced_, lights_, shapes_;
  gl::Object records_, light_, shape_, indices_, arrays_;
};

/// The opacity map of the key light. The textures 0 and 1 have the map after draw();
/// shaders/strands/shadow.glsl reads them.
class OpacityPass {
 public:
  OpacityPass(const DrawingScene& scene, std::size_t strands, bool instanced);
  void draw(const Records& in_light) const;

 private:
  int size_;
  gl::Program program_;
  Strips strips_;
  gl::Object least_, sums_, framebuffer_;
};

/// The skin, which is drawn into a renderbuffer. The texture 2 has the view depth of the skin in R after
/// draw().
class SkinPass {
 public:
  /// `colour`: the renderbuffer, of the size of the picture.
  SkinPass(const DrawingScene& scene, GLuint colour);
  void draw(glm::vec3 background) const;

 private:
  int width_, height_, indices_count_;
  gl::Program program_;
  gl::Object vertices_, indices_, arrays_, depth_, view_depth_, framebuffer_;
};

}  // namespace pelage::strands
