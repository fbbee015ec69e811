#include "harness/shells/reference/strands.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/parallel.hpp"
#include "harness/prepare/strands.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/shells/reference/vector.hpp"

namespace pelage::reference {
namespace {

/// Returns the wind force at `time` in newtons: d * strength * (1 + gust * sin(2 pi frequency * time - p)). d
/// is the unit vector of wind.direction. `phase` contains the cosine and the sine of the angle p.
glm::dvec3 wind_force(const WindScene& wind, const glm::dvec2& phase, double time) {
  const double turn = 2.0 * std::numbers::pi * double(wind.frequency) * time;
  const double sine = std::sin(turn) * phase.x - std::cos(turn) * phase.y;  // phase: (cos, sin)
  return unit(glm::dvec3(wind.direction)) * (double(wind.strength) * (1.0 + double(wind.gust) * sine));
}

}  // namespace

Strand constrain(Strand strand, const glm::dvec3& normal, double length) {
  const double height = glm::dot(strand.tip, normal);
  if (height < 0.0) {
    strand.tip -= height * normal;
    strand.velocity -= std::min(0.0, glm::dot(strand.velocity, normal)) * normal;
  }
  if (glm::length(strand.tip) > length) {
    const glm::dvec3 outward = unit(strand.tip);
    strand.tip = length * outward;
    strand.velocity -= std::max(0.0, glm::dot(strand.velocity, outward)) * outward;
  }
  return strand;
}

Strand rest(const FrameInput& input, std::size_t face) {
  return {glm::dvec3(input.strands.anchor[face]), glm::dvec3(0.0)};
}

FrameForces::FrameForces(const FrameInput& input, int first, int frames)
    : always_(input.scene.dynamics), first_(std::size_t(first)) {
  if (!forces_change(input.scene)) return;
  for (int i = 0; i < frames; ++i) frame_.push_back(dynamics_of_frame(input.scene, first + i));
}

const DynamicsScene& FrameForces::at(std::size_t substep) const {
  return frame_.empty() ? always_ : frame_.at(substep / std::size_t(always_.substeps) - first_);
}

Strand substep(const FrameInput& input, std::size_t face, Strand strand, std::size_t index) {
  const int frame = int(index / std::size_t(input.scene.dynamics.substeps));
  return substep(input, FrameForces(input, frame, 1), face, strand, index);
}

Strand substep(const FrameInput& input, const FrameForces& forces, std::size_t face, Strand strand,
               std::size_t index) {
  const DynamicsScene& dynamics = forces.at(index);
  const glm::dvec2 phase(forces.change() ? gust_phase(glm::dvec3(input.strands.root[face]), dynamics.wind)
                                         : input.strands.phase[face]);
  const double mass = double(dynamics.mass), dt = double(dynamics.step);
  const glm::dvec3 anchor(input.strands.anchor[face]);
  const glm::dvec3 force = double(dynamics.stiffness) * (anchor - strand.tip) -
                           double(dynamics.drag) * strand.velocity + mass * glm::dvec3(dynamics.gravity) +
                           wind_force(dynamics.wind, phase, double(index) * dt);
  strand.velocity += dt / mass * force;
  strand.tip += dt * strand.velocity;
  const glm::dvec3 normal(input.strands.normal[face]);
  if (has_contact(input.scene.contact)) {
    const Colliders colliders(input.scene, input.contact_fields, double(index + 1) * dt);
    const Pushed pushed =
        colliders.push({strand.tip, strand.velocity}, glm::dvec3(input.strands.root[face]), normal);
    strand = {pushed.place, pushed.velocity};
  }
  return constrain(strand, normal, double(strand_length(input.scene.fur, input.style, face)));
}

namespace {

Strand simulated(const FrameInput& input, const FrameForces& forces, std::size_t face, int frames) {
  const std::size_t count = std::size_t(std::max(0, frames)) * std::size_t(input.scene.dynamics.substeps);
  Strand strand = rest(input, face);
  for (std::size_t i = 0; i < count; ++i) strand = substep(input, forces, face, strand, i);
  return strand;
}

}  // namespace

Strand simulate(const FrameInput& input, std::size_t face, int frames) {
  return simulated(input, FrameForces(input, 0, frames), face, frames);
}

std::vector<Strand> simulate(const FrameInput& input, int frames) {
  const FrameForces forces(input, 0, frames);
  std::vector<Strand> strands(input.strands.anchor.size());
  for_each_index(strands.size(), 256,
                 [&](std::size_t face) { strands[face] = simulated(input, forces, face, frames); });
  return strands;
}

double time_after(const DynamicsScene& dynamics, int frames) {
  return double(frames) * double(dynamics.substeps) * double(dynamics.step);
}

}  // namespace pelage::reference
