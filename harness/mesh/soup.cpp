#include "harness/mesh/soup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "harness/error.hpp"
#include "harness/mesh/gltf_files.hpp"

namespace pelage {
namespace {

constexpr std::size_t most_polygons = 10'000'000;
// Some editors write these bytes (the byte order mark) at the beginning of a UTF-8 text file.
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

bool cgal_reads(std::string_view format) {
  return format == "obj" || format == "off" || format == "ply" || format == "stl";
}

bool assimp_reads(std::string_view format) {
  return format == "3ds" || format == "gltf" || format == "glb";
}

bool finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

}  // namespace

std::string ending_of(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  if (!text.empty()) text.erase(0, 1);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

bool has_mesh_ending(const std::filesystem::path& file) {
  const std::string format = ending_of(file);
  return cgal_reads(format) || assimp_reads(format);
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
  for (std::size_t i = 0; i < soup.point.size(); ++i)
    if (!finite(soup.point[i]))
      throw InputError(fmt::format("{}: a coordinate of vertex {} is not finite", name, i));
  for (std::size_t f = 0; f < soup.polygon.size(); ++f) {
    for (const std::uint32_t index : soup.polygon[f]) {
      if (index >= soup.point.size())
        throw InputError(fmt::format("{}: face {} has a vertex out of range; there are {} vertices", name, f,
                                     soup.point.size()));
    }
  }
}

Soup parse_soup(std::string bytes, std::string_view format, const std::string& name) {
  if (bytes.starts_with(byte_order_mark)) bytes.erase(0, byte_order_mark.size());
  detail::check_text(bytes, format, name);
  Soup soup;
  const bool good = detail::read_by_cgal(bytes, format, soup);
  if (!good) throw InputError(fmt::format("{}: not a readable {} file; is it truncated?", name, format));
  check_soup(soup, name);
  return soup;
}

Soup read_soup(const std::filesystem::path& file, bool with_uv) {
  const std::string format = ending_of(file);
  const bool by_cgal = cgal_reads(format);
  if (!has_mesh_ending(file))
    throw InputError(
        fmt::format("{}: meshes are read from .obj, .off, .ply, .stl, .3ds, .gltf and .glb", file.string()));
  std::string bytes = read_bytes(file, largest_mesh_file);
  const bool has_uv = with_uv && (format == "obj" || format == "ply");
  if (by_cgal && !has_uv) return parse_soup(std::move(bytes), format, file.string());
  if (by_cgal && bytes.starts_with(byte_order_mark))
    throw InputError(fmt::format(
        "{}: the file begins with a byte-order mark; pelage cannot read a UV map from such a file; save "
        "the file as UTF-8 without the mark",
        file.string()));
  if (by_cgal) detail::check_text(bytes, format, file.string());
  detail::gltf_files(file);
  Soup soup = detail::read_by_assimp(file);
  check_soup(soup, file.string());
  return soup;
}

}  // namespace pelage
