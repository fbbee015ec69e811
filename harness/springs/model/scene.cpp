#include "harness/springs/model/scene.hpp"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/prepare/moving_skin.hpp"

namespace pelage::springs {
namespace {

// Target of a poke: a point in R, and the index of the triangle that the poke's ray hits. If the scene has no
// ray, `triangle` is the number of triangles, which is not a valid index.
struct Aim {
  glm::dvec3 point;
  std::size_t triangle;
};

Aim aimed(const Mesh& mesh, const PokeScene& poke) {
  const glm::dvec3 origin(poke.point), direction = glm::normalize(glm::dvec3(poke.ray));
  const std::optional<std::size_t> found = hit(mesh, origin, direction);
  if (!found)
    throw InputError(
        fmt::format("dynamics.poke.ray: the ray from ({}, {}, {}) along ({}, {}, {}) hits no triangle of {}",
                    poke.point.x, poke.point.y, poke.point.z, poke.ray.x, poke.ray.y, poke.ray.z, mesh.name));
  glm::dvec3 corner[3];
  for (int c = 0; c < 3; ++c) corner[c] = glm::dvec3(mesh.position[mesh.triangle[*found][c]]);
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  return {origin + glm::dot(corner[0] - origin, normal) / glm::dot(direction, normal) * direction, *found};
}

}  // namespace

Dynamics dynamics_of(const DynamicsScene& scene, const SpringNetwork& network) {
  Dynamics d;
  d.solver = solver_of(scene.solver);
  d.step = scene.step;
  d.mass = scene.mass;
  d.stiffness = scene.springs.stiffness;
  d.damping = scene.springs.damping;
  d.edge_stiffness = scene.springs.edge_stiffness;
  d.edge_damping = scene.springs.edge_damping;
  d.drag = scene.drag;
  d.return_weight = scene.springs.return_weight;
  d.residual = scene.springs.residual;
  d.full_jacobian = scene.springs.jacobian == "full";
  d.gravity = scene.gravity;
  d.wind = wind_of(scene.wind, scene.drag);
  d.motion = motion_of(scene.motion);
  if (scene.springs.reference_area > 0) {
    const auto share = float(network.stick_area / double(scene.springs.reference_area));
    for (float* constant : {&d.mass, &d.stiffness, &d.damping, &d.drag, &d.return_weight}) *constant *= share;
  }
  return d;
}

SpringNetwork network_of(const Scene& scene, const Mesh& mesh) {
  return build(kind_of(scene.dynamics.topology), mesh, scene.fur.length,
               scene.dynamics.springs.vertices == "copies" ? Vertices::copies : Vertices::points,
               scene.dynamics.wind.gust_at == "triangle" ? Gusts::triangles : Gusts::sticks);
}

SpringNetwork network_of(const FrameInput& input) {
  return network_of(input.scene, *input.mesh);
}

MovedSticks moved_sticks(const FrameInput& input, const SpringNetwork& first, int frame) {
  MovedSticks moved{{}, mesh_of_frame(input, frame), {}};
  moved.network = network_of(input.scene, moved.mesh);
  moved.network.gust_at = first.gust_at;
  moved.network.stick_area = first.stick_area;
  const std::vector<glm::dvec3> velocity = skin_velocity(input, frame);
  for (const std::uint32_t point : first.point) moved.velocity.push_back(velocity[point]);
  return moved;
}

std::vector<glm::vec3> with_drag(std::vector<glm::vec3> push, const std::vector<glm::dvec3>& velocity,
                                 float drag) {
  push.resize(velocity.size(), glm::vec3(0));
  for (std::size_t i = 0; i < push.size(); ++i)
    push[i] = glm::vec3(glm::dvec3(push[i]) - double(drag) * velocity[i]);
  return push;
}

std::vector<glm::vec3> pushes(const SpringNetwork& network, const Mesh& mesh, const PokeScene& poke) {
  const bool ray = poke.ray != glm::vec3(0);
  if (poke.radius == 0 && !ray) return {};
  const Aim aim = ray ? aimed(mesh, poke) : Aim{glm::dvec3(poke.point), mesh.triangle.size()};
  std::vector<glm::vec3> force(network.sticks(), glm::vec3(0));
  const glm::dvec3 along = glm::normalize(glm::dvec3(poke.along));
  for (std::size_t f = 0; f < mesh.triangle.size(); ++f) {
    glm::dvec3 from = -aim.point;
    for (int c = 0; c < 3; ++c) from += glm::dvec3(mesh.position[mesh.triangle[f][c]]) / 3.0;
    if (f != aim.triangle && glm::length(from) > double(poke.radius)) continue;
    const glm::dvec3 across = from - glm::dot(from, along) * along;
    const double reach = glm::length(across);
    const glm::dvec3 apart = reach > 0 ? double(poke.spread) / reach * across : glm::dvec3(0);
    for (int c = 0; c < 3; ++c) force[network.corner[f][c]] = poke.force + glm::vec3(apart);
  }
  return force;
}

}  // namespace pelage::springs
