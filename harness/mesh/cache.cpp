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

}  // namespace

std::string encode(const Mesh& mesh) {
  Writer to;
  to.text(mesh.name);
  to.text(mesh.hash);
  to.list(mesh.position);
  to.list(mesh.uv);
  to.list(mesh.weld);
  to.list(mesh.triangle);
  to.value(mesh.welded);
  to.value(std::uint8_t(mesh.periodic_uv));
  to.value(mesh.length_per_uv);
  to.value(std::uint64_t(mesh.notes.size()));
  for (const std::string& note : mesh.notes) to.text(note);
  return to.sealed(mesh_cache_title);
}

std::optional<Mesh> decode(std::string_view bytes) {
  const auto content = unsealed(bytes, mesh_cache_title);
  if (!content) return {};
  Reader from(*content);
  Mesh mesh;
  std::uint8_t periodic = 0;
  std::uint64_t notes = 0;
  if (!(from.text(mesh.name) && from.text(mesh.hash) && from.list(mesh.position) && from.list(mesh.uv) &&
        from.list(mesh.weld) && from.list(mesh.triangle) && from.value(mesh.welded) && from.value(periodic) &&
        from.value(mesh.length_per_uv) && from.value(notes)))
    return {};
  mesh.periodic_uv = periodic != 0;
  for (std::string note; notes > 0; --notes) {
    if (!from.text(note)) return {};
    mesh.notes.push_back(note);
  }
  if (!from.done() || !consistent(mesh)) return {};
  return mesh;
}

std::optional<Mesh> read_cached(const std::filesystem::path& file) {
  const auto bytes = read_cache_file(file);
  return bytes ? decode(*bytes) : std::nullopt;
}

bool write_cached(const std::filesystem::path& file, const Mesh& mesh) {
  return write_cache_file(file, encode(mesh));
}

}  // namespace pelage
