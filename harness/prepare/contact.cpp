#include "harness/prepare/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/scene/scene_keys.hpp"

namespace pelage {
namespace {

/// Greatest number of distances in all fields of a mesh: 1 GiB.
constexpr std::size_t most_distances = std::size_t(1) << 28;

/// Returns the mesh with the points of all files.
std::shared_ptr<const Mesh> deforming(const std::shared_ptr<const Mesh>& mesh,
                                      const ContactMeshScene& scene) {
  auto all = std::make_shared<Mesh>(*mesh);
  all->frames = read_mesh_frames(*mesh, scene.file, scene.frames, glm::dvec3(0), "contact.mesh_frames");
  Hash hash;
  hash.text(mesh->hash);
  for (const std::vector<glm::vec3>& frame : all->frames) hash.values(frame);
  all->hash = hash.hex();
  return all;
}

}  // namespace

ContactFields contact_fields(const ContactMeshScene& scene) {
  if (scene.file.empty()) return {};
  std::shared_ptr<const Mesh> mesh;
  try {
    mesh = load_model(scene.file.string());
  } catch (const InputError& error) {
    throw InputError(fmt::format("contact.mesh: {}", error.what()));
  }
  if (!is_closed(*mesh))
    throw InputError(
        fmt::format("contact.mesh: {}: the mesh is not closed, so it has no inside; give a closed mesh",
                    scene.file.string()));
  if (scene.frames == 1) return {kept_distance_field(mesh, scene.cells)};
  mesh = deforming(mesh, scene);
  const glm::dvec3 nodes(grid_of(*mesh, scene.cells).nodes);
  const double distances = nodes.x * nodes.y * nodes.z * scene.frames;
  if (distances > double(most_distances))
    throw InputError(fmt::format(
        "contact.mesh_frames: the fields of {} files have {:.0f} distances; give fewer files or a smaller contact.mesh_cells, for at most {} distances",
        scene.frames, distances, most_distances));
  return kept_distance_fields(mesh, scene.cells);
}

ContactMoment contact_moment(const ContactMeshScene& mesh, const DynamicsScene& dynamics, double time) {
  const double since = std::max(0.0, time - double(mesh.motion.begin));
  const glm::dvec3 axis = glm::normalize(glm::dvec3(mesh.axis));
  ContactMoment m;
  const double passed =
      mesh.frames == 1 ? 0.0 : since / (double(dynamics.step) * static_cast<double>(dynamics.substeps));
  m.file = int(passed);
  m.share = passed - m.file;
  m.position = mesh.motion.moved(mesh.position, time);
  // The remainder keeps the precision of the angle after many turns.
  m.turn =
      glm::mat3_cast(glm::angleAxis(std::remainder(double(mesh.spin) * since, 2 * std::acos(-1.0)), axis));
  m.spin = double(mesh.spin) * axis;
  return m;
}

std::size_t field_of_interval(const ContactMeshScene& mesh, int interval) {
  return std::size_t(mesh.after_frames == "repeat" ? interval % mesh.frames
                                                   : std::min(interval, mesh.frames - 1));
}

DistanceField contact_field_at(const ContactFields& fields, const ContactMeshScene& mesh,
                               const DynamicsScene& dynamics, double time) {
  const ContactMoment m = contact_moment(mesh, dynamics, time);
  DistanceField field = *fields.at(field_of_interval(mesh, m.file));
  const std::vector<float>& next = fields.at(field_of_interval(mesh, m.file + 1))->distance;
  for (std::size_t i = 0; m.share > 0 && i < next.size(); ++i)
    field.distance[i] = float(std::lerp(double(field.distance[i]), double(next[i]), m.share));
  return field;
}

}  // namespace pelage
