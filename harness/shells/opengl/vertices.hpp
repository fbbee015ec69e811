// The mesh and its strands as vertex arrays (docs/shells.md, section 3). Lengths are in R, the radius of the
// mesh's bounding sphere.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

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

}  // namespace pelage::rivals
