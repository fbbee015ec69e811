#include "harness/mesh/cache.hpp"
#include "harness/mesh/read/formats.hpp"
#include "harness/mesh/read/polylines.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

void mesh(std::string_view bytes, std::string_view format) {
  may_refuse([&] { parse_soup(bytes, format, "mesh", true); });
}

void strands(std::string_view bytes, std::string_view format) {
  may_refuse([&] {
    const Polylines lines = parse_polylines(bytes, format, "strands");
    std::size_t points = 0;
    for (const std::uint32_t count : lines.count) {
      expect(count >= 2, "a strand needs two points");
      points += count;
    }
    expect(points == lines.point.size(), "each point belongs to a strand");
    expect(lines.width.empty() || lines.width.size() == points, "each point has a width");
    expect(lines.colour.empty() || lines.colour.size() == points, "each point has a colour");
  });
}

void gltf(std::string_view bytes) {
  may_refuse([&] {
    for (const std::filesystem::path& file : detail::gltf_files(bytes, "/nowhere/mesh.gltf"))
      expect(file.string().starts_with("/nowhere/"), "a glTF file may name only files in its folder");
    detail::read_gltf(std::string(bytes), "/nowhere/mesh.gltf", true);
  });
}

void cached(std::string_view bytes) {
  Writer writer;
  for (const char byte : bytes) writer.value(byte);
  if (const auto found = decode(writer.sealed(mesh_cache_title)))
    expect(decode(encode(*found)).has_value(), "the decoded mesh cannot be encoded again");
}

void archive(std::string_view bytes) {
  const MemoryFile file(bytes);
  may_refuse([&] { read_member(file.path(), "data/meshes/a.off"); });
}

}  // namespace pelage::fuzz
