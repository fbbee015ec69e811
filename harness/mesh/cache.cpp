#include "harness/mesh/cache.hpp"

namespace pelage {
namespace {

bool consistent(const Mesh& mesh) {
  const std::size_t copies = mesh.position.size();
  if (mesh.uv.size() != copies || mesh.weld.size() != copies) return false;
  for (const std::uint32_t point : mesh.weld)
    if (point >= mesh.welded) return false;
  for (const glm::uvec3& t : mesh.triangle)
    if (t.x >= copies || t.y >= copies || t.z >= copies) return false;
  return !mesh.hash.empty();  // the checksum of the file covers the hash and all that it was computed from
}

constexpr auto mesh_parts = [](const auto& store, auto& mesh) {
  std::uint8_t periodic = mesh.periodic_uv;
  const bool stored = store(mesh.name) && store(mesh.hash) && store(mesh.position) && store(mesh.uv) &&
                      store(mesh.weld) && store(mesh.triangle) && store(mesh.welded) && store(periodic) &&
                      store(mesh.length_per_uv) && store(mesh.notes);
  if constexpr (!std::is_const_v<std::remove_reference_t<decltype(mesh)>>) mesh.periodic_uv = periodic != 0;
  return stored;
};

}  // namespace

std::string encode(const Mesh& mesh) {
  return packed(mesh_cache_title, mesh_parts, mesh);
}

std::optional<Mesh> decode(std::string_view bytes) {
  auto mesh = unpacked<Mesh>(bytes, mesh_cache_title, mesh_parts);
  return mesh && consistent(*mesh) ? std::move(mesh) : std::nullopt;
}

}  // namespace pelage
