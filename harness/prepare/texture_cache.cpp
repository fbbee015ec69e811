#include <fmt/format.h>

#include "harness/hash.hpp"
#include "harness/mesh/disk_cache.hpp"
#include "harness/prepare/coat.hpp"
#include "harness/prepare/fur_texture.hpp"
#include "harness/scene/scene_toml.hpp"

namespace pelage {
namespace {

/// The members of a texture, in the order of its file.
bool parts(const auto& store, auto& texture) requires requires {
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
bool parts(const auto& store, auto& texture) requires requires {
  texture.texel;
}
{ return store(texture.size) && store(texture.texel); }
bool parts(const auto& store, std::vector<glm::vec3>& points) {
  return store(points);
}

template <class Make>
auto kept_texture(const std::string& name, Hash key, const Make& make) {
  const std::filesystem::path file =
      cache_folder() / "textures" / fmt::format("{}-{}", name, key.number(texture_recipe).hex());
  return cached<decltype(make())>(
      file, "pelage texture 1\n", std::uintmax_t(512) << 20,
      [](const auto& store, auto& texture) { return parts(store, texture); }, make);
}

}  // namespace

FurTexture kept_fur_texture(const FurScene& fur) {
  // The hash contains all keys of the section `fur`. If the hash omitted a key, the cache could return the
  // texture of a scene with another value of this key.
  Scene scene;
  scene.fur = fur;
  return kept_texture("fur", Hash().text(scene_hash(scene)), [&] { return make_fur_texture(fur); });
}

CoatTexture kept_coat(const Mesh& mesh, const CoatScene& coat) {
  if (!coat.image.empty() || mesh.hash.empty()) return make_coat(mesh, coat);
  Scene scene;
  scene.coat = coat;
  return kept_texture("coat", Hash().text(mesh.hash).text(scene_hash(scene)),
                      [&] { return make_coat(mesh, coat); });
}

std::vector<glm::vec3> kept_surface_map(const Mesh& mesh, int size) {
  if (mesh.hash.empty()) return surface_map(mesh, size);
  return kept_texture("map", Hash().text(mesh.hash).number(std::uint64_t(size)),
                      [&] { return surface_map(mesh, size); });
}

}  // namespace pelage
