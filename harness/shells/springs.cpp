#include "harness/shells/springs.hpp"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "harness/error.hpp"

namespace pelage::shells {
namespace {

springs::MassSprings at_rest(const cl::Queue& queue, const FrameInput& input, int lanes) {
  const springs::Topology topology = topology_of(input);
  springs::MassSpringOptions options;
  options.lanes = lanes;
  springs::MassSprings masses(queue, topology, dynamics_of(input.scene.dynamics), options);
  masses.push(queue, pushes(topology, *input.mesh, input.scene.dynamics.poke));
  return masses;
}

// For each drawn vertex where its stick's q_x lies; a padding vertex takes the first stick's.
std::vector<std::int32_t> columns(const springs::MassSprings& masses, const Geometry& g) {
  const std::vector<std::int32_t> of_stick = masses.offset_columns();
  std::vector<std::int32_t> found(std::size_t(g.vertices), of_stick.front());
  for (std::size_t i = 0; i < g.stick.size(); ++i) found[i] = of_stick[g.stick[i]];
  return found;
}

// Where a poke is aimed at: a point, and the triangle that a ray meets there.
struct Aim {
  glm::dvec3 point;
  std::size_t triangle;
};

Aim aimed(const Mesh& mesh, const PokeScene& poke) {
  const glm::dvec3 origin(poke.point), direction = glm::normalize(glm::dvec3(poke.ray));
  const std::optional<std::size_t> found = springs::hit(mesh, origin, direction);
  if (!found)
    throw InputError(
        fmt::format("dynamics.poke.ray: from ({}, {}, {}) along ({}, {}, {}) it meets no triangle of {}",
                    poke.point.x, poke.point.y, poke.point.z, poke.ray.x, poke.ray.y, poke.ray.z, mesh.name));
  glm::dvec3 corner[3];
  for (int c = 0; c < 3; ++c) corner[c] = glm::dvec3(mesh.position[mesh.triangle[*found][c]]);
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  return {origin + glm::dot(corner[0] - origin, normal) / glm::dot(direction, normal) * direction, *found};
}

}  // namespace

springs::Dynamics dynamics_of(const DynamicsScene& scene) {
  springs::Dynamics d;
  d.solver = springs::solver_of(scene.solver);
  d.step = scene.step;
  d.mass = scene.mass;
  d.stiffness = scene.springs.stiffness;
  d.damping = scene.springs.damping;
  d.edge_stiffness = scene.springs.edge_stiffness;
  d.edge_damping = scene.springs.edge_damping;
  d.drag = scene.drag;
  d.return_weight = scene.springs.return_weight;
  d.residual = scene.springs.residual;
  d.gravity = scene.gravity;
  const WindScene& wind = scene.wind;
  d.wind = {wind.direction, scene.drag > 0 ? wind.strength / scene.drag : 0, wind.gust, wind.frequency,
            wind.wavelength};
  const MotionScene& m = scene.motion;
  d.motion = {m.velocity, m.shake, m.shake_frequency, m.axis, m.spin, m.swing, m.swing_frequency};
  return d;
}

springs::Topology topology_of(const FrameInput& input) {
  return springs::build(springs::kind_of(input.scene.dynamics.topology), *input.mesh, input.scene.fur.length);
}

std::vector<glm::vec3> pushes(const springs::Topology& topology, const Mesh& mesh, const PokeScene& poke) {
  const bool ray = poke.ray != glm::vec3(0);
  if (poke.radius == 0 && !ray) return {};
  const Aim aim = ray ? aimed(mesh, poke) : Aim{glm::dvec3(poke.point), mesh.triangle.size()};
  std::vector<glm::vec3> force(topology.sticks(), glm::vec3(0));
  const glm::dvec3 along = glm::normalize(glm::dvec3(poke.along));
  for (std::size_t f = 0; f < mesh.triangle.size(); ++f) {
    glm::dvec3 from = -aim.point;
    for (int c = 0; c < 3; ++c) from += glm::dvec3(mesh.position[mesh.triangle[f][c]]) / 3.0;
    if (f != aim.triangle && glm::length(from) > double(poke.radius)) continue;
    const glm::dvec3 across = from - glm::dot(from, along) * along;
    const double reach = glm::length(across);
    const glm::dvec3 apart = reach > 0 ? double(poke.spread) / reach * across : glm::dvec3(0);
    for (int c = 0; c < 3; ++c) force[topology.corner[f][c]] = poke.force + glm::vec3(apart);
  }
  return force;
}

SpringStage::SpringStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry, int lanes)
    : masses_(at_rest(queue, input, lanes)),
      program_(queue.device(), "rasterize/sticks.cl", build_options(lanes, {})),
      tips_(program_, "stick_tips"),
      stick_(queue, std::span<const std::int32_t>(columns(masses_, geometry))),
      substeps_(input.scene.dynamics.substeps),
      lanes_(lanes),
      level_(input.scene.dynamics.bend == "tangent") {
  const DynamicsScene& scene = input.scene.dynamics;
  if (scene.tolerance > 0)
    adaptive_.emplace(float(scene.substeps) * scene.step, scene.substeps, scene.tolerance);
}

void SpringStage::frame(const cl::Queue& queue, PhaseEvents* events) {
  std::vector<cl::Event> launches;
  if (adaptive_)
    adaptive_->advance(queue, masses_, events ? &launches : nullptr);
  else
    masses_.enqueue(queue, substeps_, events ? &launches : nullptr);
  if (!events) return;
  for (cl::Event& launch : launches) events->emplace_back("simulate", std::move(launch));
}

void SpringStage::tips(const cl::Queue& queue, RasterStage& raster, PhaseEvents* events) {
  tips_.with(raster.params(), level_, stick_, masses_.offset(), raster.vertex(), raster.tip());
  cl::Event event = tips_.enqueue(queue, std::size_t(raster.params().vertices / lanes_));
  if (events) events->emplace_back("transform", std::move(event));
}

}  // namespace pelage::shells
