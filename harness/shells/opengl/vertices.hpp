// The mesh and its strands as vertex arrays (docs/frame.md, section 3).
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::rivals {

/// The attributes of a vertex that are the same in all frames.
struct Vertex {
  glm::vec3 position;  ///< R
  glm::vec2 uv;
  glm::vec3 a;               ///< A, R
  glm::vec3 curl_u, curl_v;  ///< (1 - rho) K_alpha u and v, R
  glm::vec3 dx_du, dx_dv;    ///< R per UV unit
};

class Vertices {
 public:
  /// Makes one vertex per vertex copy of the mesh, or three per triangle if `corners` is true or fur.binding
  /// is "separate".
  Vertices(const FrameInput& input, const std::vector<glm::vec4>& mask, bool corners);

  const std::vector<Vertex>& fixed() const { return fixed_; }
  /// 3 F vertex indices; the triangles are in the order of the mesh.
  const std::vector<std::uint32_t>& index() const { return index_; }
  /// Returns B of every vertex, in R: the weighted mean of the strands of its triangles. `tips` has one entry
  /// per strand: tip minus root, in R.
  std::vector<glm::vec3> bent(const std::vector<glm::vec3>& tips) const;

 private:
  template <class OfStrand>
  glm::dvec3 mean(std::size_t vertex, const OfStrand& of_strand) const;

  const FrameInput* input_;
  bool separate_;
  std::vector<std::uint32_t> copy_;  ///< index of each vertex's copy in the mesh
  std::vector<Vertex> fixed_;
  std::vector<std::uint32_t> index_;
};

}  // namespace pelage::rivals
