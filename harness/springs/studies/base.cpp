#include "harness/springs/studies/base.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/error.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/springs/model/scene.hpp"

namespace pelage::springs {

Scene scene_with_springs(const SubjectContext& context, const Case& which) {
  Scene scene = scene_of(context.experiment, which);
  if (!has_springs(scene.dynamics))
    throw InputError(fmt::format(
        "{}: dynamics.topology is {}; this experiment needs sticks, prisms, separable-sticks or separable-prisms",
        which.name, scene.dynamics.topology));
  if (forces_change(scene))
    throw InputError(fmt::format(
        "{}: this pipeline does not draw, and uses no keyframes of forces; use shells or reference",
        which.name));
  if (has_contact(scene.contact))
    throw InputError(
        fmt::format("{}: contact: this pipeline does not draw, and has no colliders; use shells or reference",
                    which.name));
  if (scene.mesh.frames > 1)
    throw InputError(fmt::format(
        "{}: mesh.frames: this pipeline does not draw, and needs a mesh that does not deform; give 1",
        which.name));
  return scene;
}

Setting setting_of(SubjectContext& context, const Scene& scene) {
  SpringNetwork network = network_of(scene, *context.mesh_of(scene));
  const Dynamics dynamics = dynamics_of(scene.dynamics, network);
  return {std::move(network), dynamics, {}, 0};
}

const Motions& exact_of(SubjectContext& context, const Scene& scene, const Setting& setting) {
  // The exact solution does not depend on step, substeps, tolerance and solver.
  Scene any = scene;
  any.dynamics.step = 1;
  any.dynamics.substeps = 1;
  any.dynamics.tolerance = 0;
  any.dynamics.solver = highest_order.name;
  std::any& exact = context.shared["exact second of " + scene_hash(any)];
  if (!exact.has_value()) exact = exact_second(setting.network, setting.dynamics, 1e-4f);
  return std::any_cast<const Motions&>(exact);
}

Motions rest_motions(const SpringNetwork& network) {
  Motions state;
  for (const glm::vec3& n : network.normal) state.offset.push_back(network.length * n);
  state.speed.assign(network.sticks(), glm::vec3(0));
  return state;
}

reference::State reference_state(const SpringNetwork& network, const Motions& motions) {
  reference::State state = reference::rest(network);
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    state.position[network.top(i)] = state.position[i] + glm::dvec3(motions.offset[i]);
    state.velocity[network.top(i)] = glm::dvec3(motions.speed[i]);
  }
  return state;
}

std::vector<glm::vec3> reference_offsets(const SpringNetwork& network, const Dynamics& dynamics,
                                         const Motions& start, long first, long steps) {
  const std::vector<glm::dvec3> offsets = reference::offsets(
      network, reference::after({network, dynamics}, reference_state(network, start), first, steps));
  return {offsets.begin(), offsets.end()};
}

void simulate(const cl::Queue& queue, MassSprings& masses, const Dynamics& dynamics, double seconds,
              double look, const std::function<bool(double)>& after) {
  const long steps = std::max(1L, std::lround(seconds / double(dynamics.step)));
  const int launch = int(std::clamp(std::lround(look / double(dynamics.step)), 1L, 20000L));
  for (long done = 0; done < steps;) {
    const int count = int(std::min<long>(launch, steps - done));
    masses.enqueue(queue, count);
    done += count;
    if (after && !after(double(done) * double(dynamics.step))) break;
  }
  queue.finish();
}

void bounded(const cl::Queue& queue, const MassSprings& masses) {
  try {
    masses.check(queue);
  } catch (const Diverged& error) {
    throw OutOfBounds(error.what());
  }
}

void Study::describe(Row& row) {
  row.metrics["triangles"] = {double(setting_.network.corner.size()), "triangles"};
  row.metrics["sticks"] = {double(setting_.network.sticks()), "sticks"};
  row.metrics["stick_area"] = {setting_.network.stick_area, "R^2"};
  row.metrics["step_ms"] = {1e3 * double(setting_.dynamics.step), "ms"};
  row.identity.insert(programs_.begin(), programs_.end());
}

Cost Study::from_rest(MassSprings& masses, double seconds) const {
  const Motions start = rest_motions(setting_.network);
  masses.set(queue_, start.offset, start.speed);
  queue_.finish();
  return cost_of([&] { simulate(queue_, masses, setting_.dynamics, seconds); });
}

}  // namespace pelage::springs
