// Grows the fur layers of a scene on a mesh: key strands at the mesh's surface points, and the strands
// between them. docs/strands.md, section Authoring, defines the fur.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/mesh/read/polylines.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/strands/chain/chain.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands {

/// The smallest box with edges parallel to the object's axes that contains the roots and the tips of a
/// layer's straight strands at rest. Unit: R, the radius of the mesh's bounding sphere.
struct LayerBounds {
  glm::vec3 low{0}, high{0};
};

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
  /// Of strands of a file: the shape of each element of `strands`. A strand has one or more of them, and
  /// `keys` has one element per strand. Null: grown fur.
  std::shared_ptr<const std::vector<StrandShape>> shapes;
};

/// Returns the fur of all layers. The same arguments give the same fur on every machine. The coat gives the
/// colour at the roots. Throws InputError if a picture of the scene cannot be read or is not usable, or if a
/// layer has no place for strands; the message names the scene key.
Fur grow(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat);

/// The two steps of grow(). grow_layers() reads only `strands.layers` and `strands.chain.first_segment`. The
/// stiffnesses and limits of the chains that grow_layers() returns are the factors of the layers.
/// set_chains() multiplies them by those of the scene.
Fur grow_layers(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat);
void set_chains(Fur& fur, const ChainScene& chain);

/// Returns the fur of the strands of a file (docs/grooms.md), with the colours,
/// the look and the motion of the only fur layer. Throws InputError if a picture of the scene cannot be read.
Fur fur_of_file(const PlacedStrands& placed, const StrandsScene& strands, const CoatTexture& coat);

/// Version of the code that grows fur. The name of every cache file contains it. Increase it whenever a
/// change of the code changes the fur. tests/strands/groom/fur_cache_test.cpp detects such changes by a hash.
constexpr int fur_recipe = 4;

/// Returns the same fur as grow(). Reads it from the cache if it was grown before for the same mesh, coat and
/// fur layers, including the content of their pictures. Grows it again if the cache file is damaged. If the
/// cache folder is not writable, or if the mesh has no hash, every call grows the fur.
Fur kept_fur(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat);

/// Returns the rank of each layer in a view, for LayerLook::rank. D: "Layer bounds are initially calculated
/// by their member strands and sorted back-to-front, but additional controls bias and offset the order." Rank
/// 0 is in front. The layers are sorted by the view depth of the centre of their bounds plus their bias (R);
/// equal depths by their number. Then each layer moves back by its offset, a number of places. A layer with
/// an offset below 0 moves to the front. If two layers move to the same place, the one with the larger offset
/// is behind. The three lists have equal lengths of at most 256.
std::vector<std::uint8_t> layer_ranks(std::span<const LayerBounds> bounds, const Camera& camera,
                                      std::span<const float> biases, std::span<const int> offsets);

}  // namespace pelage::strands
