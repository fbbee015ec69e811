// GLSL programs, and their inputs from the scene: constants, "#define" lines, the layer table and textures.
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
#include "harness/shells/opengl/opengl.hpp"

namespace pelage::gl {

/// A constant of the scene that the shaders read: 1 to 4 floats.
struct Constant {
  std::string name;
  std::vector<float> value;
};

std::vector<Constant> scene_constants(const FrameInput& input);

/// Returns the "#define" lines that select the parts of the shaders to compile. `wet` is true if any texel of
/// the mask is wet.
std::string scene_defines(const FrameInput& input, const OpenGlOptions& options, bool wet);

/// Returns three vectors per layer, which shaders/layers.glsl calls "bend", "step" and "look". The shaders
/// compute the positions of the vertices from "bend", the strand direction from "step", and the displacement
/// by clumps and the self-shadow from "look". shaders/layers.glsl describes the components of the vectors.
std::vector<glm::vec4> layer_table(const Scene& scene);

/// Returns the program of the files `vertex` and `fragment` of the shader folder. Both shaders get `defines`
/// and `constants`, whose values are literals. Throws DeviceError with OpenGL's log if OpenGL cannot compile
/// or link the shaders.
gl::Program scene_program(const std::string& vertex, const std::string& fragment, const std::string& defines,
                          const std::vector<Constant>& constants);

/// Returns the "#define" lines of the scene's colliders; "" without colliders.
std::string contact_defines(const FrameInput& input);

/// Returns the distance field of the mesh among the colliders as a 3D texture; one texel without a mesh.
gl::Object field_texture(const FrameInput& input);

/// Sets the uniforms of shaders/contact.glsl in `program` to the colliders at `time`, in s since the start of
/// the simulation. If the mesh among them deforms, uploads its field at this time to the texture `field`.
void set_colliders(GLuint program, GLuint field, const FrameInput& input, double time);

/// Returns the fur texture with the mip levels of `fur`. OpenGL does the filtering that docs/shells.md,
/// section 6, defines.
gl::Object fur_texture(const FurTexture& fur, const OpenGlOptions& options);
gl::Object coat_texture(const CoatTexture& coat, const OpenGlOptions& options);
/// Returns the wetness mask as a texture of floats with NEAREST filtering. The four floats of a texel are the
/// centre (u, v) and the radius of a clump, and the wetness.
gl::Object mask_texture(const std::vector<glm::vec4>& mask, int size);

/// Returns the map of the density as a texture; a texture of one texel without a map. The top row of the
/// texture is at v = 1.
gl::Object density_texture(const Style::Density& map);
/// Returns the angles of the curls for all factors of curl.turns: the texel (k, n) holds the cosine and the
/// sine of the angle in layer n for the factor k / turn_steps, times the height of the layer. One texel
/// without curl.turns_map.
gl::Object turns_texture(const FrameInput& input);

// The mesh and its strands as vertex arrays (docs/shells.md, section 3), and the triangles that are drawn of
// them. Lengths are in R.

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
  /// Returns the tip offset B of every vertex: the weighted mean of `tips`, the vectors from root to tip, of
  /// the strands around the vertex.
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

}  // namespace pelage::gl
