#include <fmt/format.h>

#include "harness/hash.hpp"
#include "harness/mesh/disk_cache.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/strands/groom/fur.hpp"

namespace pelage::strands {
namespace {

/// The hash of everything that grow_layers() reads.
std::string key_of(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat) {
  Scene scene;
  scene.strands.layers = strands.layers;
  scene.strands.chain.first_segment = strands.chain.first_segment;
  for (StrandLayerScene& layer : scene.strands.layers) {
    layer.order_bias = StrandLayerScene{}.order_bias;
    layer.order_offset = StrandLayerScene{}.order_offset;
  }
  return Hash()
      .text(mesh.hash)
      .text(scene_hash(scene))
      .number(std::uint64_t(coat.size))
      .values(coat.texel)
      .number(fur_recipe)
      .hex();
}

}  // namespace

Fur kept_fur(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat) {
  if (mesh.hash.empty()) return grow(mesh, strands, coat);
  const auto lists = [](const auto& store, auto& fur) {
    return store(fur.keys) && store(fur.chains) && store(fur.points) && store(fur.strands) &&
           store(fur.bounds) && store(fur.layers) && store(fur.film);
  };
  Fur fur = cached<Fur>(cache_folder() / "fur" / key_of(mesh, strands, coat), "pelage fur 1\n",
                        std::uintmax_t(512) << 20, lists, [&] { return grow_layers(mesh, strands, coat); });
  set_chains(fur, strands.chain);
  return fur;
}

}  // namespace pelage::strands
