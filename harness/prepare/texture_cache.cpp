#include "harness/prepare/texture_cache.hpp"

#include <fmt/format.h>

#include "harness/hash.hpp"
#include "harness/mesh/disk_cache.hpp"
#include "harness/prepare/coat.hpp"
#include "harness/prepare/fur_texture.hpp"
#include "harness/prepare/surface_map.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

constexpr std::string_view title = "pelage texture 1\n";
constexpr std::uintmax_t most_kept = std::uintmax_t(512) << 20;

// parts() calls `store` for each member of a texture. read() and write() both call parts(), so they process
// the same members in the same order. parts() returns false as soon as `store` returns false.
template <class Store>
bool parts(Store&& store, auto& texture) requires requires {
  texture.level;
}
{
  std::uint64_t levels = texture.level.size();
  if (!store(texture.size) || !store(texture.layers) || !store(levels) || levels > 32) return false;
  texture.level.resize(levels);
  for (auto& level : texture.level)
    if (!store(level)) return false;
  return true;
}
template <class Store>
bool parts(Store&& store, auto& texture) requires requires {
  texture.texel;
}
{ return store(texture.size) && store(texture.texel); }
template <class Store>
bool parts(Store&& store, std::vector<glm::vec3>& points) {
  return store(points);
}

template <class Texture>
std::optional<Texture> read(const std::filesystem::path& file) {
  const auto bytes = read_cache_file(file);
  const auto content = bytes ? unsealed(*bytes, title) : std::nullopt;
  if (!content) return {};
  Reader from(*content);
  Texture texture;
  const auto load = [&]<class T>(T& part) {
    if constexpr (std::is_trivially_copyable_v<T>)
      return from.value(part);
    else
      return from.list(part);
  };
  if (!parts(load, texture) || !from.done()) return {};
  return texture;
}

template <class Texture>
void write(const std::filesystem::path& file, Texture& texture) {
  Writer to;
  parts(
      [&]<class T>(T& part) {
        if constexpr (std::is_trivially_copyable_v<T>)
          to.value(part);
        else
          to.list(part);
        return true;
      },
      texture);
  if (write_cache_file(file, to.sealed(title))) trim_cache(file.parent_path(), most_kept);
}

template <class Make>
auto kept(const std::string& name, Hash key, const Make& make) {
  using Texture = decltype(make());
  const std::filesystem::path file =
      cache_folder() / "textures" / fmt::format("{}-{}", name, key.number(texture_recipe).hex());
  if (auto texture = read<Texture>(file)) return std::move(*texture);
  Texture texture = make();
  write(file, texture);
  return texture;
}

}  // namespace

FurTexture kept_fur_texture(const FurScene& fur) {
  // The hash contains all keys of the section `fur`. If the hash omitted a key, the cache could return the
  // texture of a scene with another value of this key.
  Scene scene;
  scene.fur = fur;
  return kept("fur", Hash().text(scene_hash(scene)), [&] { return make_fur_texture(fur); });
}

CoatTexture kept_coat(const Mesh& mesh, const CoatScene& coat) {
  if (!coat.image.empty() || mesh.hash.empty()) return make_coat(mesh, coat);
  Scene scene;
  scene.coat = coat;
  return kept("coat", Hash().text(mesh.hash).text(scene_hash(scene)), [&] { return make_coat(mesh, coat); });
}

std::vector<glm::vec3> kept_surface_map(const Mesh& mesh, int size) {
  if (mesh.hash.empty()) return surface_map(mesh, size);
  return kept("map", Hash().text(mesh.hash).number(std::uint64_t(size)),
              [&] { return surface_map(mesh, size); });
}

}  // namespace pelage
