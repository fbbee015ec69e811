#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/case_conv.hpp>
#include <fstream>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "harness/error.hpp"
#include "harness/mesh/read/formats.hpp"

namespace pelage {
namespace {

constexpr std::size_t most_polygons = 10'000'000;
// Some editors write these bytes (the byte order mark) at the beginning of a UTF-8 text file.
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

}  // namespace

std::string ending_of(const std::filesystem::path& file) {
  const std::string text = boost::algorithm::to_lower_copy(file.extension().string());
  return text.empty() ? text : text.substr(1);
}

bool has_mesh_ending(const std::filesystem::path& file) {
  static constexpr std::array<std::string_view, 7> formats{"obj", "off", "ply", "stl", "3ds", "gltf", "glb"};
  return std::ranges::find(formats, ending_of(file)) != formats.end();
}

std::string read_bytes(const std::filesystem::path& file, std::uint64_t limit) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError(fmt::format("{}: no such file", file.string()));
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(fmt::format("{}: not a file", file.string()));
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) throw InputError(fmt::format("{}: cannot be read: {}", file.string(), error.message()));
  if (size == 0) throw InputError(fmt::format("{}: the file is empty", file.string()));
  if (size > limit)
    throw InputError(
        fmt::format("{}: {} MiB; at most {} MiB are read", file.string(), size >> 20, limit >> 20));
  std::string bytes(size, '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in.read(bytes.data(), std::streamsize(size)))
    throw InputError(fmt::format("{}: cannot be read; check its permissions", file.string()));
  return bytes;
}

void check_soup(const Soup& soup, const std::string& name) {
  if (soup.point.empty() || soup.polygon.empty())
    throw InputError(fmt::format("{}: the file contains no faces", name));
  if (soup.polygon.size() > most_polygons)
    throw InputError(
        fmt::format("{}: {} faces; at most {} are read", name, soup.polygon.size(), most_polygons));
  glm::dvec3 low(largest_coordinate), high(-low);
  for (std::size_t i = 0; i < soup.point.size(); ++i) {
    low = glm::min(low, soup.point[i]), high = glm::max(high, soup.point[i]);
    if (!glm::all(glm::lessThanEqual(glm::abs(soup.point[i]), glm::dvec3(largest_coordinate))))
      throw InputError(fmt::format("{}: the coordinates of vertex {} must be numbers from {} to {}", name, i,
                                   -largest_coordinate, largest_coordinate));
  }
  if (glm::all(glm::lessThan(high - low, glm::dvec3(1 / largest_coordinate))))
    throw InputError(fmt::format("{}: the surface is smaller than {:g}", name, 1 / largest_coordinate));
  for (std::size_t f = 0; f < soup.uv.size(); ++f)
    if (!soup.uv[f].empty() && soup.uv[f].size() != soup.polygon[f].size())
      throw InputError(fmt::format("{}: face {} has {} corners, but texture coordinates for {}", name, f,
                                   soup.polygon[f].size(), soup.uv[f].size()));
  for (std::size_t f = 0; f < soup.polygon.size(); ++f)
    for (const std::uint32_t index : soup.polygon[f])
      if (index >= soup.point.size())
        throw InputError(fmt::format("{}: face {} has a vertex out of range; there are {} vertices", name, f,
                                     soup.point.size()));
}

std::string_view detail::text_of(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    throw InputError(fmt::format("{}: UTF-16 text, which is not read; save the file as UTF-8", name));
  if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
  return bytes;
}

Soup parse_soup(std::string_view bytes, std::string_view format, const std::string& name, bool with_uv) {
  bytes = detail::text_of(bytes, name);
  Soup soup = format == "obj"   ? detail::read_obj(bytes, name, with_uv)
              : format == "off" ? detail::read_off(bytes, name, with_uv)
              : format == "ply" ? detail::read_ply(bytes, name, with_uv)
              : format == "3ds" ? detail::read_3ds(bytes, name, with_uv)
                                : detail::read_stl(bytes, name);
  check_soup(soup, name);
  return soup;
}

Soup read_soup(const std::filesystem::path& file, bool with_uv) {
  const std::string format = ending_of(file);
  if (!has_mesh_ending(file))
    throw InputError(
        fmt::format("{}: meshes are read from .obj, .off, .ply, .stl, .3ds, .gltf and .glb", file.string()));
  const std::string bytes = read_bytes(file, largest_mesh_file);
  if (format != "gltf" && format != "glb") return parse_soup(bytes, format, file.string(), with_uv);
  Soup soup = detail::read_gltf(bytes, file, with_uv);
  check_soup(soup, file.string());
  return soup;
}

}  // namespace pelage
