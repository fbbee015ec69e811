#include "harness/prepare/placed_strands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/mesh/finish.hpp"
#include "harness/mesh/search.hpp"
#include "harness/parallel.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/prepare/skin.hpp"
#include "harness/scene/scene_keys.hpp"

namespace pelage {
namespace {

/// Strands whose roots are further from the surface, in R, are not those of this mesh.
constexpr float most_distance = 0.1f;
/// A distance that the note about moved roots does not mention, R: rounding.
constexpr float least_distance = 1e-5f;

/// The sphere around all points: its centre is that of the bounding box.
Placement around(const Polylines& lines, glm::dmat3 turn) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
  for (const glm::vec3& p : lines.point)
    low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
  const glm::dvec3 centre = 0.5 * (low + high);
  double radius = 0;
  for (const glm::vec3& p : lines.point) radius = std::max(radius, glm::distance(glm::dvec3(p), centre));
  return {turn, centre, radius};
}

void move(Polylines& lines, const Placement& place) {
  for (glm::vec3& p : lines.point) p = glm::vec3(place(glm::dvec3(p)));
  for (float& width : lines.width) width = float(double(width) / place.radius);
}

/// Moves each strand so that its root is the nearest point of the surface. Returns how far each was moved, R.
std::vector<float> put_on(const std::shared_ptr<const Mesh>& mesh, PlacedStrands& strands) {
  const SurfaceSearch search(mesh);
  const Skin skin = weld(*mesh);
  Polylines& lines = strands.lines;
  const std::vector<std::size_t> first = first_points(lines);
  std::vector<float> moved(first.size());
  for_each_index(first.size(), 64, [&](std::size_t i) {
    const glm::vec3 root = lines.point[first[i]];
    const SurfacePlace place = search.closest(root);
    glm::dvec3 normal(0);
    for (int k = 0; k < 3; ++k)
      normal += double(place.weight[k]) * skin.normal[mesh->weld[mesh->triangle[place.triangle][k]]];
    if (!(glm::length(normal) > 1e-6)) normal = skin.face_normal[place.triangle];
    strands.normal[i] = glm::vec3(glm::normalize(normal));
    strands.uv[i] = place.uv;
    strands.triangle[i] = place.triangle;
    moved[i] = glm::distance(root, place.point);
    const glm::vec3 step = place.point - root;
    for (std::size_t k = 0; k < lines.count[i]; ++k) lines.point[first[i] + k] += step;
    lines.point[first[i]] = place.point;
  });
  return moved;
}

void need_near(std::vector<float> moved, const Scene& scene) {
  const auto middle = moved.begin() + std::ptrdiff_t(moved.size() / 2);
  std::ranges::nth_element(moved, middle);
  if (*middle > most_distance)
    throw InputError(fmt::format(
        "strands.file: {}: half of the roots are more than {:.2f} R from the surface of {}; give strands.file_unit = \"{}\", another model, or model = \"{}\" for the strands alone",
        scene.strands.file.string(), *middle, scene.model, scene.strands.file_unit == "R" ? "mesh" : "R",
        no_model));
}

Placement placement_on(const Scene& scene, const Mesh& mesh) {
  if (scene.strands.file_unit == "R") return {};
  if (!is_model_file(scene.model))
    throw InputError(fmt::format(
        "strands.file_unit: \"mesh\" needs the coordinates of a mesh file, but the model is {}; give \"R\"",
        scene.model));
  return placement_of(mesh, scene.model, glm::dvec3(rotation_of(scene.mesh)), "strands.file_unit");
}

}  // namespace

Polylines read_strands(const Scene& scene) {
  try {
    return read_polylines(scene.strands.file);
  } catch (const InputError& error) {
    throw InputError(fmt::format("strands.file: {}", error.what()));
  }
}

std::shared_ptr<const Mesh> with_strands(const Scene& scene, Polylines polylines,
                                         const std::shared_ptr<const Mesh>& mesh,
                                         const std::function<void(const std::string&)>& progress) {
  auto strands = std::make_shared<PlacedStrands>();
  strands->lines = std::move(polylines);
  Polylines& lines = strands->lines;
  auto result = std::make_shared<Mesh>();
  if (mesh) *result = *mesh;
  if (!result->from_file) result->notes.clear();  // of pelage's own models, which are no warnings
  std::vector<std::string> notes{fmt::format("{}: {}; each moves as a chain of two segments",
                                             scene.strands.file.string(), describe(lines))};
  for (const std::string& note : lines.notes) notes.push_back(note);
  const std::size_t count = lines.count.size();
  strands->uv.resize(count);
  strands->normal.resize(count);
  strands->triangle.resize(count);
  if (mesh) {
    move(lines, placement_on(scene, *mesh));
    const std::vector<float> moved = put_on(mesh, *strands);
    need_near(moved, scene);
    if (const float most = std::ranges::max(moved); most > least_distance)
      notes.push_back(fmt::format(
          "the strands were moved so that their roots are on the surface, by at most {:.2g} R", most));
  } else {
    move(lines, around(lines, rotation_matrix(glm::dvec3(rotation_of(scene.mesh)))));
    const std::vector<std::size_t> first = first_points(lines);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 step = glm::dvec3(lines.point[first[i] + 1]) - glm::dvec3(lines.point[first[i]]);
      strands->normal[i] = glm::length(step) > 0 ? glm::vec3(glm::normalize(step)) : glm::vec3(0, 1, 0);
    }
    result->name = no_model;
  }
  if (!mesh || !mesh->hash.empty()) {  // a mesh of a test may have none
    Hash hash;
    hash.text(result->hash).values(lines.count).values(lines.point);
    result->hash = hash.values(lines.width).values(lines.colour).hex();
  }
  result->from_file = true;
  result->strands = std::move(strands);
  for (const std::string& note : notes) {
    if (progress) progress(note);
    result->notes.push_back(note);
  }
  return result;
}

}  // namespace pelage
