// The mesh and its strands as vertex arrays (docs/shells.md, section 3), and the triangles that are drawn of
// them. Lengths are in R.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "harness/gl/objects.hpp"
#include "harness/gl/program.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opengl/program.hpp"

namespace pelage::rivals {

/// The attributes of a vertex that are the same in all frames. The axes of the curl are the same if the
/// wetness mask is.
struct Vertex {
  glm::vec3 position;
  glm::vec2 uv;
  glm::vec3 a;               ///< fur.length times the weighted mean normal of the strands around the vertex
  glm::vec3 curl_u, curl_v;  ///< axes of the curl, multiplied by the curl's radius and the dryness
  glm::vec3 dx_du, dx_dv;    ///< derivatives of the position with respect to u and v
  float turn;                ///< factor of curl.turns times turn_steps: a whole number
};

class Vertices {
 public:
  /// Makes one OpenGL vertex for each vertex of the mesh. If fur.binding is "separate", makes three OpenGL
  /// vertices for each triangle instead, so triangles share no vertices.
  Vertices(const FrameInput& input, const std::vector<glm::vec4>& mask);

  /// Computes the axes of the curl for another mask.
  void set_mask(const std::vector<glm::vec4>& mask);
  const std::vector<Vertex>& fixed() const { return fixed_; }
  /// Returns three vertex indices per triangle. The triangles are in the order of the mesh.
  const std::vector<std::uint32_t>& index() const { return index_; }
  /// Returns the tip offset B of every vertex. B is the weighted mean of the tips of the strands around the
  /// vertex. `tips` has one entry per strand: the vector from the root to the tip.
  std::vector<glm::vec3> bent(const std::vector<glm::vec3>& tips) const;

 private:
  template <class OfStrand>
  glm::dvec3 mean(std::size_t vertex, const OfStrand& of_strand) const;

  const FrameInput* input_;
  bool separate_;
  std::vector<std::uint32_t> copy_;  ///< for each vertex of `fixed_`, the index of its vertex in the mesh
  std::vector<Vertex> fixed_;
  std::vector<std::uint32_t> index_;
};

/// Triangles of one layer in the element buffer of SeenTriangles.
struct SeenPart {
  int layer = 0;
  GLsizei corners = 0;    ///< number of elements
  std::size_t first = 0;  ///< place of the first element
};

/// Finds the triangles of each layer that cover a pixel in front of the base surface. The other triangles
/// change no pixel, so a pipeline that leaves them out draws the same picture.
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

/// The numbers of the triangles whose base faces away from the eye and towards it (docs/shells.md, section
/// 5). Both lists keep the mesh's order.
struct Facing {
  std::vector<std::uint32_t> away, towards;
};

/// Returns the facing of each triangle's base. The signed area of the screen positions, rounded to 1/256
/// pixel, decides. A triangle that crosses the near plane or the guard band is not rounded.
Facing facing(const Camera& camera, const Mesh& mesh);

/// Returns the elements of `index`, which has three per triangle, of the triangles in `list`.
std::vector<std::uint32_t> elements_of(const std::vector<std::uint32_t>& list,
                                       const std::vector<std::uint32_t>& index);

}  // namespace pelage::rivals
