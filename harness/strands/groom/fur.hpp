// Grows the fur layers of a scene on a mesh: key strands at the mesh's surface points, and the strands
// between them. docs/strands.md, section Authoring, defines the fur.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/strands/chain/chain.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"
#include "harness/strands/groom/layer_order.hpp"

namespace pelage::strands {

/// The fur of a scene at rest.
struct Fur {
  std::vector<KeyStrand> keys;        ///< one per fur layer and surface point (Mesh::weld) that has strands
  std::vector<Chain> chains;          ///< constants of the key strands' motion, in the order of `keys`
  std::vector<std::uint32_t> points;  ///< the surface point (Mesh::weld) of each key strand
  std::vector<KeyedStrand> strands;   ///< of all layers, in the order of prefix_order()
  std::vector<LayerBounds> bounds;    ///< one per fur layer
  /// One entry per fur layer, for Look::layers. The rank of a layer is its number; layer_ranks() returns the
  /// ranks for a view.
  std::vector<LayerLook> layers;
  std::vector<FilmFrame> film;  ///< the film strips of all layers, for Look::film
};

/// Returns the fur of all layers. The same arguments give the same fur on every machine. The coat gives the
/// colour at the roots. Throws InputError if a picture of the scene cannot be read or is not usable, or if a
/// layer has no place for strands; the message names the scene key.
Fur grow(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat);

/// The two steps of grow(). grow_layers() reads only `strands.layers` and `strands.chain.first_segment`. The
/// stiffnesses of the chains that grow_layers() returns are the factors of the
/// layers. set_chains() multiplies them by the stiffnesses of the scene, and sets the limits of the angles.
Fur grow_layers(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat);
void set_chains(Fur& fur, const ChainScene& chain);

}  // namespace pelage::strands
