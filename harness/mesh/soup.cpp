#include "harness/mesh/soup.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <charconv>
#include <cmath>
#include <compare>
#include <cstring>
#include <fstream>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <tuple>

#include "harness/error.hpp"
#include "harness/mesh/steps.hpp"

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

[[noreturn]] void damaged(const std::filesystem::path& file) {
  throw InputError(fmt::format("{}: the archive is damaged; install its package again", file.string()));
}

using Indices = std::vector<std::uint32_t>;
using Corners = std::vector<glm::dvec2>;  // UV of the corners of a face, or empty

std::tuple<double, double, double> key(const glm::dvec3& p) {
  return {p.x, p.y, p.z};
}

/// Compares the corner lists of two faces, read from the corners `a` and `b` on. The points decide; if all of
/// them are equal, their UV decide.
std::partial_ordering compare(const Indices& face, const Corners& uv, std::size_t a, const Indices& other,
                              const Corners& other_uv, std::size_t b) {
  const std::size_t n = face.size();
  if (const auto order = n <=> other.size(); std::is_neq(order)) return order;
  for (std::size_t k = 0; k < n; ++k)
    if (const auto order = face[(a + k) % n] <=> other[(b + k) % n]; std::is_neq(order)) return order;
  for (std::size_t k = 0; k < n && !uv.empty(); ++k) {
    const glm::dvec2 p = uv[(a + k) % n], q = other_uv[(b + k) % n];
    if (const auto order = std::tie(p.x, p.y) <=> std::tie(q.x, q.y); std::is_neq(order)) return order;
  }
  return std::partial_ordering::equivalent;
}

Indices order_of(std::size_t count) {
  Indices order(count);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

/// Sorts the points, and returns the new number of each old point.
Indices sort_points(std::vector<glm::dvec3>& point) {
  Indices order = order_of(point.size()), number(point.size());
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return key(point[i]); });
  std::vector<glm::dvec3> sorted;
  sorted.reserve(point.size());
  std::uint32_t first = 0;  // of the coincident points
  for (const std::uint32_t i : order) {
    if (sorted.empty() || sorted[first] != point[i]) first = std::uint32_t(sorted.size());
    sorted.push_back(point[i] + 0.0);
    number[i] = first;
  }
  point = std::move(sorted);
  return number;
}

}  // namespace

std::string ending_of(const std::filesystem::path& file) {
  const std::string text = boost::algorithm::to_lower_copy(file.extension().string());
  return text.empty() ? text : text.substr(1);
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
  glm::dvec3 low(largest_coordinate), high(-low);
  for (std::size_t i = 0; i < soup.point.size(); ++i) {
    low = glm::min(low, soup.point[i]), high = glm::max(high, soup.point[i]);
    if (!glm::all(glm::lessThanEqual(glm::abs(soup.point[i]), glm::dvec3(largest_coordinate))))
      throw InputError(fmt::format("{}: the coordinates of vertex {} must be numbers from {} to {}", name, i,
                                   -largest_coordinate, largest_coordinate));
  }
  if (glm::all(glm::lessThan(high - low, glm::dvec3(1 / largest_coordinate))))
    throw InputError(fmt::format("{}: the surface is smaller than {:g}", name, 1 / largest_coordinate));
  for (std::size_t f = 0; f < soup.polygon.size(); ++f)
    for (const std::uint32_t index : soup.polygon[f])
      if (index >= soup.point.size())
        throw InputError(fmt::format("{}: face {} has a vertex out of range; there are {} vertices", name, f,
                                     soup.point.size()));
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
        "{}: the file begins with a byte-order mark; pelage cannot read a UV map from such a file; save the file as UTF-8 without the mark",
        file.string()));
  if (by_cgal) detail::check_text(bytes, format, file.string());
  detail::gltf_files(file);
  Soup soup = detail::read_by_assimp(file);
  check_soup(soup, file.string());
  return soup;
}

std::optional<std::string> read_member(const std::filesystem::path& file, const std::string& member) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError(fmt::format("{}: no such file", file.string()));
  const std::unique_ptr<archive, int (*)(archive*)> reader(archive_read_new(), archive_read_free);
  archive_read_support_filter_gzip(reader.get());
  archive_read_support_format_tar(reader.get());
  if (archive_read_open_filename(reader.get(), file.c_str(), 1 << 16) != ARCHIVE_OK) damaged(file);
  archive_entry* entry = nullptr;
  for (;;) {
    // After a warning (ARCHIVE_WARN) the entry is readable. libarchive warns, for instance, if the locale
    // cannot represent the entry's name.
    const int status = archive_read_next_header(reader.get(), &entry);
    if (status == ARCHIVE_EOF) return {};
    if (status < ARCHIVE_WARN) damaged(file);
    const char* name = archive_entry_pathname(entry);
    if (name && name == member) break;
  }
  const std::int64_t size = archive_entry_size(entry);
  if (size > std::int64_t(largest_mesh_file))
    throw InputError(fmt::format("{}: {} is too large", file.string(), member));
  // A damaged header may state a size that is far larger than the file. Therefore memory is allocated only
  // for the bytes that were read.
  std::string bytes, chunk(1 << 16, '\0');
  while (std::int64_t(bytes.size()) < size) {
    const la_ssize_t count = archive_read_data(reader.get(), chunk.data(), chunk.size());
    if (count <= 0) damaged(file);
    bytes.append(chunk.data(), std::size_t(count));
  }
  return bytes;
}

void sort_soup(Soup& soup) {
  const Indices number = sort_points(soup.point);
  const Corners none;
  const auto uv_of = [&](std::size_t f) -> const Corners& { return soup.uv.empty() ? none : soup.uv[f]; };
  for (std::size_t f = 0; f < soup.polygon.size(); ++f) {
    Indices& face = soup.polygon[f];
    for (std::uint32_t& i : face) i = number[i];
    std::size_t start = 0;
    for (std::size_t k = 1; k < face.size(); ++k)
      if (std::is_lt(compare(face, uv_of(f), k, face, uv_of(f), start))) start = k;
    std::rotate(face.begin(), face.begin() + std::ptrdiff_t(start), face.end());
    if (!soup.uv.empty())
      std::rotate(soup.uv[f].begin(), soup.uv[f].begin() + std::ptrdiff_t(start), soup.uv[f].end());
  }
  Indices order = order_of(soup.polygon.size());
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::is_lt(compare(soup.polygon[a], uv_of(a), 0, soup.polygon[b], uv_of(b), 0));
  });
  Soup sorted;
  for (const std::uint32_t f : order) {
    sorted.polygon.push_back(std::move(soup.polygon[f]));
    if (!soup.uv.empty()) sorted.uv.push_back(std::move(soup.uv[f]));
  }
  soup.polygon = std::move(sorted.polygon);
  soup.uv = std::move(sorted.uv);
}

}  // namespace pelage

namespace pelage::detail {
namespace {

namespace fs = std::filesystem;

/// Returns the JSON text of a glTF file. A binary file (.glb) begins with a header of 12 bytes. The JSON
/// chunk follows the header. It consists of the length of its text, its type and its text.
std::string_view json_text(std::string_view bytes) {
  constexpr std::size_t header = 12, chunk = 8;
  if (!bytes.starts_with("glTF")) return bytes;
  std::uint32_t length;
  if (bytes.size() < header + chunk) return {};
  std::memcpy(&length, bytes.data() + header, sizeof length);
  return bytes.substr(header + chunk, length);
}

/// Replaces each percent-encoded byte by the byte itself, for example %20 by a space.
std::string decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    if (uri[i] == '%' && i + 2 < uri.size()) {
      const auto [end, error] = std::from_chars(&uri[i + 1], &uri[i + 3], code, 16);
      if (error == std::errc{} && end == &uri[i + 3]) {
        text += char(code);
        i += 2;
        continue;
      }
    }
    text += uri[i];
  }
  return text;
}

}  // namespace

std::vector<fs::path> gltf_files(const fs::path& file) {
  const std::string ending = ending_of(file);
  if (ending != "gltf" && ending != "glb") return {};
  return gltf_files(read_bytes(file, largest_mesh_file), file);
}

std::vector<fs::path> gltf_files(std::string_view bytes, const fs::path& file) {
  const auto json = nlohmann::json::parse(json_text(bytes), nullptr, false);
  std::vector<fs::path> files;
  if (!json.is_object()) return files;
  for (const char* list : {"buffers", "images"}) {
    if (!json.contains(list) || !json.at(list).is_array()) continue;
    for (const auto& entry : json.at(list)) {
      if (!entry.is_object() || !entry.contains("uri") || !entry.at("uri").is_string()) continue;
      const std::string uri = decoded(entry.at("uri").get<std::string>());
      if (uri.starts_with("data:")) continue;
      const fs::path path = fs::path(uri).lexically_normal();
      if (path.is_absolute() || path.empty() || *path.begin() == ".." || uri.find("://") != std::string::npos)
        throw InputError(
            fmt::format("{}: this glTF file refers to '{}'; it may refer only to files in its own folder",
                        file.string(), uri));
      files.push_back(file.parent_path() / path);
      std::error_code error;
      if (!fs::is_regular_file(files.back(), error))
        throw InputError(
            fmt::format("{}: this glTF file refers to '{}', which does not exist or is not a regular file",
                        file.string(), uri));
    }
  }
  return files;
}

}  // namespace pelage::detail

namespace pelage {
namespace {

// Returns true if the area of the map in UV space exceeds 1e-12 times the area of its bounding square. A
// smaller UV area may be rounded to 0 in single precision. Mesh::length_per_uv and the tangents would then be
// undefined.
bool has_area(const std::vector<Surface::Corners>& uv) {
  double twice = 0;
  glm::dvec2 low = uv.front().front(), high = low;
  for (const Surface::Corners& t : uv) {
    twice += std::abs(twice_uv_area(t));
    for (const glm::dvec2& p : t) low = glm::min(low, p), high = glm::max(high, p);
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  return twice / 2 > 1e-12 * side * side;
}

}  // namespace

Surface weld(const Soup& soup, const std::string& name) {
  Surface surface;
  std::map<std::tuple<double, double, double>, std::uint32_t> seen;
  std::vector<std::optional<std::uint32_t>> number(soup.point.size());
  const auto welded = [&](std::uint32_t i) {
    const glm::dvec3& p = soup.point[i];
    if (!number[i]) number[i] = seen.try_emplace({p.x, p.y, p.z}, std::uint32_t(seen.size())).first->second;
    if (*number[i] == surface.point.size()) surface.point.push_back(p);
    return *number[i];
  };
  std::size_t dropped = 0;
  for (std::size_t f = 0; f < soup.polygon.size(); ++f) {
    const auto& polygon = soup.polygon[f];
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      const glm::dvec3 &a = soup.point[polygon[0]], &b = soup.point[polygon[k]],
                       &c = soup.point[polygon[k + 1]];
      if (a == b || b == c || c == a) {
        ++dropped;
        continue;
      }
      surface.triangle.push_back({welded(polygon[0]), welded(polygon[k]), welded(polygon[k + 1])});
      surface.uv.push_back({soup.uv[f][0], soup.uv[f][k], soup.uv[f][k + 1]});
    }
  }
  if (surface.triangle.empty()) throw InputError(fmt::format("{}: no face with an area is left", name));
  if (!has_area(surface.uv))
    throw InputError(fmt::format("{}: the file's UV map has no area; leave out --keep-uv", name));
  surface.keep_uv = true;
  surface.notes.push_back("kept the file's own UV map; nothing was repaired");
  if (surface.point.size() < soup.point.size())
    surface.notes.push_back(
        fmt::format("coincident or unused points left out: {}", soup.point.size() - surface.point.size()));
  if (dropped > 0) surface.notes.push_back(fmt::format("dropped {} degenerate faces", dropped));
  return surface;
}

}  // namespace pelage
