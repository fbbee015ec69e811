// Steps in which fur grows. docs/strands.md defines locks in section Authoring.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/prepare/picture_map.hpp"
#include "harness/prepare/skin.hpp"
#include "harness/scene/strands_scene.hpp"
#include "harness/strands/chain/chain.hpp"
#include "harness/strands/drawing/keyed.hpp"
#include "harness/strands/groom/roots.hpp"

namespace pelage::strands {

struct Fur;

/// All maps of a fur layer except the film strip: pictures in UV space that vary the layer's values over the
/// surface.
struct LayerMaps {
  /// Reads the pictures of the layer. `name` is the layer's name in messages, for instance
  /// "strands.layer[1]".
  LayerMaps(const StrandLayerScene& layer, const std::string& name);

  /// Returns the layer's relative density of strands at a root, 0 to 1: the value of the density map divided
  /// by the map's largest value. It is 0 outside of the layer's region and of its mask, and where length or
  /// width are 0.
  double density(const Mesh& mesh, const Root& root) const;
  /// Returns for each triangle whether the density is 0 on the whole triangle. A triangle of density 0 may
  /// have the value false.
  std::vector<bool> bare(const Mesh& mesh) const;
  /// Throws InputError if the layer has no place for strands. The message names the scene key, and the
  /// picture if it is the reason.
  void require_place(const Mesh& mesh) const;

  StrandLayerScene layer;
  std::string name;
  LumaMap mask, density_map, length, width, stiffness, response, curvature, twist;
  std::optional<PictureMap> comb;

 private:
  double most_density_;

  /// A condition for strands at a point: the scene key that it comes from, and the picture if there is one.
  struct Condition {
    std::string key;
    std::filesystem::path file;
    std::function<double(const Mesh&, const Root&)> density;
    std::function<bool(const Mesh&, std::uint32_t face)> possible;
  };
  std::vector<Condition> conditions() const;
};

/// Key strands at rest and the constants of their chains, in the same order.
struct KeyStrands {
  std::vector<KeyStrand> keys;
  /// The stiffnesses and the limits of a chain are factors here: those of the fur layer and of its map.
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

struct LockOptions {
  std::size_t locks = 0;       ///< the first `locks` strands are the middles of the locks
  float pull = 0;              ///< part of the way from a strand's tip to the tip of its middle, 0 to 1
  float first_segment = 0.5f;  ///< length of the first segment, in lengths of the strand
};

/// Turns, bends and lengthens the strands at rest, so that their tips move towards the tips of the middles of
/// their locks. A strand belongs to the lock whose middle has the nearest root on the same side of the skin.
void pull_into_locks(std::span<KeyedStrand> strands, const std::vector<KeyStrand>& keys,
                     const LockOptions& options);

/// Adds the looks of the fur layers to Fur::layers, and their film strips to Fur::film. If one layer has a
/// film strip and another has none, the latter gets a frame of factors 1. Throws InputError if a film strip
/// cannot be read or is not usable.
void add_film(const std::vector<StrandLayerScene>& layers, Fur& fur);

/// Returns the order in which strands are stored: the indices of the strands, such that each prefix of the
/// order is spread over the surface almost as evenly as all strands, and strands that are near each other in
/// the order share key strands.
///
/// place[i] is a number from 0 to 1: the place of strand i in the random permutation of its fur layer,
/// divided by the layer's number of strands. In the permutation of scatter_roots(), each prefix is blue
/// noise. near[i] is a number that is similar for neighbouring strands, such as the number of the triangle.
/// The function sorts the strands by `place`, and cuts the sorted list into blocks. The strands of a block
/// are then sorted by `near`. A block has a sixteenth of the number of the strands before it, and at least 16
/// strands. A prefix that ends within a block therefore has at most 1/16 more strands per area on one part of
/// the surface than on the other part.
std::vector<std::uint32_t> prefix_order(std::span<const float> place, std::span<const std::uint32_t> near);

}  // namespace pelage::strands
