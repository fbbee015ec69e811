#include "harness/strands/groom/fur_cache.hpp"

#include <fmt/format.h>

#include "harness/hash.hpp"
#include "harness/mesh/disk_cache.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage::strands {
namespace {

constexpr std::string_view title = "pelage fur 1\n";
constexpr std::uintmax_t most_kept = std::uintmax_t(512) << 20;

/// Calls `store` for each list of the fur, in the same order for reading and for writing. Returns false as
/// soon as `store` returns false.
template <class Store>
bool lists(Store&& store, auto& fur) {
  return store(fur.keys) && store(fur.chains) && store(fur.points) && store(fur.strands) &&
         store(fur.bounds) && store(fur.layers) && store(fur.film);
}

std::optional<Fur> read(const std::filesystem::path& file) {
  const auto bytes = read_cache_file(file);
  const auto content = bytes ? unsealed(*bytes, title) : std::nullopt;
  if (!content) return {};
  Reader from(*content);
  Fur fur;
  if (!lists([&](auto& list) { return from.list(list); }, fur) || !from.done()) return {};
  return fur;
}

void write(const std::filesystem::path& file, const Fur& fur) {
  Writer to;
  lists(
      [&](const auto& list) {
        to.list(list);
        return true;
      },
      fur);
  if (write_cache_file(file, to.sealed(title))) trim_cache(file.parent_path(), most_kept);
}

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
  const std::filesystem::path file = cache_folder() / "fur" / key_of(mesh, strands, coat);
  std::optional<Fur> fur = read(file);
  if (!fur) {
    fur = grow_layers(mesh, strands, coat);
    write(file, *fur);
  }
  set_chains(*fur, strands.chain);
  return *std::move(fur);
}

}  // namespace pelage::strands
