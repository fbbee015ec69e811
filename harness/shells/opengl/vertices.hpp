// The mesh and its strands as vertex arrays (docs/frame.md, 3).
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::rivals {

/// What of a vertex does not move. Three components each: as many floats as the shader reads.
struct Vertex {
  glm::vec3 position;  ///< R
  glm::vec2 uv;
  glm::vec3 a;               ///< A, R
  glm::vec3 curl_u, curl_v;  ///< (1 - rho) K_alpha u and v, R
  glm::vec3 dx_du, dx_dv;    ///< R per UV unit
};

class Vertices {
 public:
  /// The mesh's own vertices, or with `corners` three per triangle (always with fur.binding = "separate").
  Vertices(const FrameInput& input, const std::vector<glm::vec4>& mask, bool corners);

  const std::vector<Vertex>& fixed() const { return fixed_; }
  const std::vector<std::uint32_t>& index() const { return index_; }  ///< 3 F, triangles in the mesh's order
  /// B of every vertex: the mean of its triangles' strands, R. `tips`: F, p minus root.
  std::vector<glm::vec3> bent(const std::vector<glm::vec3>& tips) const;

 private:
  template <class OfStrand>
  glm::dvec3 mean(std::size_t vertex, const OfStrand& of_strand) const;

  const FrameInput* input_;
  bool separate_;
  std::vector<std::uint32_t> copy_;  ///< the mesh's vertex copy behind each vertex
  std::vector<Vertex> fixed_;
  std::vector<std::uint32_t> index_;
};

}  // namespace pelage::rivals
