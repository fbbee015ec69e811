#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/isolated/isolated.hpp"
#include "harness/mesh/disk_cache.hpp"
#include "harness/mesh/finish.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/mesh/near_points.hpp"
#include "harness/mesh/read/soup.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

// A surface point and the point of the file from which it comes are nearer than this distance, R. The
// positions of a Mesh are rounded to single precision.
constexpr double near = 1e-5;
// If two points of the file coincide in the first frame, their distance in a later frame may be at most this
// number, R.
constexpr double together = 1e-4;
/// Limit of the points of all frames: 4 GiB.
constexpr std::uint64_t most_points = (std::uint64_t(4) << 30) / sizeof(glm::vec3);

/// The points of a mesh file.
struct Points {
  std::vector<glm::dvec3> position;
  std::vector<std::uint8_t> used;  ///< true: a face has this point
  std::string faces;               ///< hash of the faces
};

constexpr std::string_view title = "pelage mesh frame\n";
constexpr auto point_parts = [](const auto& store, auto& points) {
  return store(points.position) && store(points.used) && store(points.faces);
};

Points read_points(const fs::path& file) {
  const auto read = [&](const Say&) {
    const Soup soup = read_soup(file, false);
    Points points{soup.point, std::vector<std::uint8_t>(soup.point.size(), false), {}};
    Hash hash;
    for (const auto& polygon : soup.polygon) {
      hash.values(polygon);
      for (const std::uint32_t i : polygon) points.used[i] = true;
    }
    points.faces = hash.hex();
    return packed(title, point_parts, points);
  };
  std::error_code none;
  const std::uint64_t bytes = fs::is_regular_file(file, none) ? fs::file_size(file, none) : 0;
  const Limits limits{mesh_memory(bytes), std::chrono::seconds(60 + 10 * (bytes >> 20))};
  auto points = unpacked<Points>(isolated(file.string(), limits, read, {}), title, point_parts);
  if (!points)
    throw std::runtime_error(fmt::format("{}: the reading process returned damaged data", file.string()));
  return std::move(*points);
}

/// An axis-aligned box.
struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::max()}, high{-std::numeric_limits<double>::max()};
  void add(glm::dvec3 p) { low = glm::min(low, p), high = glm::max(high, p); }
};

Placement placement_from(const Mesh& mesh, const Points& first, glm::dvec3 rotation) {
  const glm::dmat3 turn = rotation_matrix(rotation);
  Bounds file, prepared;
  for (std::size_t i = 0; i < first.position.size(); ++i)
    if (first.used[i]) file.add(first.position[i]);
  for (const glm::vec3& p : mesh.position) prepared.add(glm::transpose(turn) * glm::dvec3(p));
  const double radius = glm::length(file.high - file.low) / glm::length(prepared.high - prepared.low);
  return {turn, 0.5 * ((file.low + file.high) - radius * (prepared.low + prepared.high)), radius};
}

/// Returns the points of the file that belong to each surface point, the nearest one first.
std::vector<std::vector<std::uint32_t>> coincident_of(const Mesh& mesh, const Points& first,
                                                      const Placement& place, const fs::path& file,
                                                      std::string_view key) {
  NearPoints cells(near);
  for (std::uint32_t i = 0; i < first.position.size(); ++i)
    if (first.used[i]) cells.add(place(first.position[i]), i);
  std::vector<std::vector<std::uint32_t>> points(mesh.welded);
  std::vector<glm::dvec3> position(mesh.welded);
  for (std::size_t v = 0; v < mesh.position.size(); ++v) position[mesh.weld[v]] = mesh.position[v];
  for (std::uint32_t w = 0; w < mesh.welded; ++w) {
    const auto gap = [&](std::uint32_t i) { return glm::distance(place(first.position[i]), position[w]); };
    std::vector<std::uint32_t>& point = points[w];
    cells.around(position[w], [&](std::uint32_t i) {
      if (gap(i) < near) point.push_back(i);
    });
    if (point.empty())
      throw InputError(fmt::format(
          "{}: {}: the preparation of this mesh moved, added or removed points, so its frames cannot be matched; give a mesh whose preparation changes no points (`pelage mesh` lists the changes)",
          key, file.string()));
    const auto nearest = std::ranges::min_element(point, {}, gap);
    std::rotate(point.begin(), nearest, nearest + 1);
  }
  return points;
}

}  // namespace

Placement placement_of(const Mesh& mesh, const fs::path& file, glm::dvec3 rotation, std::string_view key) {
  const Points points = read_points(file);
  const Placement place = placement_from(mesh, points, rotation);
  Bounds placed, prepared;
  for (std::size_t i = 0; i < points.position.size(); ++i)
    if (points.used[i]) placed.add(glm::transpose(place.turn) * place(points.position[i]));
  for (const glm::vec3& p : mesh.position) prepared.add(glm::transpose(place.turn) * glm::dvec3(p));
  constexpr double most = 1e-3;  // R; decimation moves the sides by less
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(placed.low[axis] - prepared.low[axis]) <= most &&
          std::abs(placed.high[axis] - prepared.high[axis]) <= most))
      throw InputError(fmt::format(
          "{}: the preparation of {} moved the sides of its bounding box, so coordinates of the file cannot be placed; give coordinates in R, or a mesh whose preparation removes nothing (`pelage mesh` lists the changes)",
          key, file.string()));
  return place;
}

fs::path frame_file(const fs::path& first, int frame, std::string_view key) {
  const std::string stem = first.stem().string();
  const std::size_t last = stem.find_last_of("0123456789");
  if (last == std::string::npos)
    throw InputError(fmt::format(
        "{}: {}: the name of the first frame's file needs a number that counts up, such as walk-0000.obj",
        key, first.string()));
  const std::size_t first_digit = stem.find_last_not_of("0123456789", last) + 1;  // npos + 1 is 0
  const std::size_t begin = std::max(first_digit, last > 17 ? last - 17 : 0);
  const std::string digits = stem.substr(begin, last + 1 - begin);
  const std::string number = fmt::format("{:0{}}", std::stol(digits) + frame, digits.size());
  return first.parent_path() /
         (stem.substr(0, begin) + number + stem.substr(last + 1) + first.extension().string());
}

std::vector<std::vector<glm::vec3>> read_mesh_frames(const Mesh& mesh, const fs::path& first, int count,
                                                     glm::dvec3 rotation, std::string_view key) {
  if (std::uint64_t(count) * mesh.welded > most_points)
    throw InputError(fmt::format("{}: {} frames of {} points; all frames together may have at most {} points",
                                 key, count, mesh.welded, most_points));
  const Points rest = read_points(first);
  const Placement place = placement_from(mesh, rest, rotation);
  const std::vector<std::vector<std::uint32_t>> coincident = coincident_of(mesh, rest, place, first, key);
  std::vector<std::vector<glm::vec3>> frames(static_cast<std::size_t>(count));
  for (int frame = 0; frame < count; ++frame) {
    const fs::path file = frame_file(first, frame, key);
    const Points points = frame == 0 ? rest : read_points(file);
    if (points.position.size() != rest.position.size() || points.faces != rest.faces)
      throw InputError(fmt::format(
          "{}: {}: the points or faces are not those of {}; all frames need the same points and faces in the same order",
          key, file.string(), first.string()));
    std::vector<glm::vec3>& position = frames[std::size_t(frame)];
    for (const std::vector<std::uint32_t>& point : coincident) {
      const glm::dvec3 here = place(points.position[point.front()]);
      for (const std::uint32_t other : std::span(point).subspan(1))
        if (const glm::dvec3 there = place(points.position[other]); glm::distance(here, there) > together)
          throw InputError(fmt::format(
              "{}: {}: the points {} and {} coincide in the first frame and part here; give them different positions in the first frame",
              key, file.string(), std::min(point.front(), other) + 1, std::max(point.front(), other) + 1));
      position.emplace_back(here);
    }
  }
  return frames;
}

}  // namespace pelage
