// The skin below the strands of a picture (docs/strands.md, section Skin). R is the radius of the mesh's
// bounding sphere.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::strands {

/// A triangle mesh with colours. Positions and normals are in the object's frame. position, normal and colour
/// have one element per vertex.
struct SkinSurface {
  std::vector<glm::vec3> position;   ///< R
  std::vector<glm::vec3> normal;     ///< unit vector
  std::vector<glm::vec3> colour;     ///< gamma-encoded, each component 0 to 1
  std::vector<glm::uvec3> triangle;  ///< indices of the vertices
};

/// Returns the surface of the mesh. The colour of a vertex is the coat's colour at its UV times `factor`. The
/// normal of a vertex is the area-weighted mean of the normals of the triangles around its surface point.
SkinSurface skin_surface(const Mesh& mesh, const CoatTexture& coat, glm::vec3 factor);

}  // namespace pelage::strands
