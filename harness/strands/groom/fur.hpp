// Grows fur on a mesh: key strands at the mesh's surface points, and the strands between them.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands {

/// A fur layer. R is the radius of the mesh's bounding sphere.
struct FurLayer {
  std::size_t count = 10000;   ///< number of strands
  std::uint32_t seed = 1;      ///< seed of all random values
  float length = 0.1f;         ///< mean length of a strand, R
  float length_spread = 0.3f;  ///< largest relative deviation of a length from the mean, 0 to below 1
  float width = 0.002f;        ///< width at the root, R
  float lean = 40;             ///< angle between the normal and the strand at rest, 0 to 90 degrees
  glm::vec3 comb{0, -1, 0};    ///< direction in which the strands lean, projected onto the surface
  glm::vec3 colour{0.55f, 0.42f, 0.30f};  ///< mean colour, gamma-encoded, each component 0 to 1
  float colour_spread = 0.2f;             ///< largest relative deviation of a strand's brightness, 0 to 1
};

/// Key strands, and strands between them.
struct Fur {
  std::vector<KeyStrand> keys;       ///< at rest; one per surface point of the mesh (Mesh::weld)
  std::vector<KeyedStrand> strands;  ///< in the order of the triangles, so that neighbours share key strands
};

/// Returns the fur of one layer at rest. The same arguments give the same fur on every machine. Throws
/// InputError if a value is outside its valid range.
Fur grow(const Mesh& mesh, const FurLayer& layer);

}  // namespace pelage::strands
