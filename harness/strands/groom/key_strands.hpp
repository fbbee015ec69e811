// The key strands of a fur layer: its strands at the mesh's surface points.
#pragma once
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/skin.hpp"
#include "harness/strands/chain/chain.hpp"
#include "harness/strands/drawing/keyed.hpp"
#include "harness/strands/groom/layer_maps.hpp"
#include "harness/strands/groom/roots.hpp"

namespace pelage::strands {

/// Key strands at rest and the constants of their chains, in the same order.
struct KeyStrands {
  std::vector<KeyStrand> keys;
  /// The stiffnesses of a chain are factors here: those of the fur layer and of its map.
  std::vector<Chain> chains;
  std::vector<std::uint32_t> point;  ///< the surface point (Mesh::weld) at each root
  /// For each surface point (Mesh::weld), the index of its key strand. The value is meaningless for a point
  /// without key strand.
  std::vector<std::uint32_t> index;
};

/// Returns the key strands of a layer with the given roots: one for each corner of a triangle that has a
/// root, in the order of the surface points. Throws InputError if the layer's comb map has no direction at
/// one of them.
KeyStrands key_strands(const Mesh& mesh, const Skin& skin, const LayerMaps& maps,
                       const std::vector<Root>& roots);

}  // namespace pelage::strands
