// Finds the triangles of each layer that cover a pixel in front of the base surface. The other triangles
// change no pixel, so a pipeline that leaves them out draws the same picture.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "harness/gl/objects.hpp"
#include "harness/gl/program.hpp"
#include "harness/shells/opengl/facing.hpp"
#include "harness/shells/opengl/program.hpp"

namespace pelage::rivals {

/// Triangles of one layer in the element buffer of SeenTriangles.
struct SeenPart {
  int layer = 0;
  GLsizei corners = 0;    ///< number of elements
  std::size_t first = 0;  ///< place of the first element
};

class SeenTriangles {
 public:
  /// defines, constants: see scene_program(). The layers must be drawn by one call each.
  SeenTriangles(const std::string& defines, const std::vector<Constant>& constants);

  /// Finds the triangles. The depth buffer of the bound framebuffer must hold the depth of the base surface,
  /// and the vertex array must be that of the layers with the element buffer `index`. layers: from
  /// layer_table(). sweeps: the triangles in the order of drawing; each sweep draws its triangles in all
  /// layers.
  void find(const std::vector<std::uint32_t>& index, const std::vector<glm::vec4>& layers,
            const std::vector<std::vector<std::uint32_t>>& sweeps);

  GLuint buffer() const { return buffer_.id(); }                 ///< elements of all parts
  const std::vector<SeenPart>& parts() const { return parts_; }  ///< in the order of drawing

 private:
  gl::Program program_;
  gl::Object buffer_ = gl::make_buffer(nullptr, 4, 0);  // OpenGL has no empty buffers
  std::vector<SeenPart> parts_;
};

}  // namespace pelage::rivals
