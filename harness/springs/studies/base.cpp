#include "harness/springs/studies/base.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pelage::springs {

Motions rest_motions(const SpringNetwork& topology) {
  Motions state;
  for (const glm::vec3& n : topology.normal) state.offset.push_back(topology.length * n);
  state.speed.assign(topology.sticks(), glm::vec3(0));
  return state;
}

reference::State reference_state(const SpringNetwork& topology, const Motions& motions) {
  reference::State state = reference::rest(topology);
  for (std::size_t i = 0; i < topology.sticks(); ++i) {
    state.position[topology.top(i)] = state.position[i] + glm::dvec3(motions.offset[i]);
    state.velocity[topology.top(i)] = glm::dvec3(motions.speed[i]);
  }
  return state;
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
  row.metrics["triangles"] = {double(setting_.topology.corner.size()), "triangles"};
  row.metrics["sticks"] = {double(setting_.topology.sticks()), "sticks"};
  row.metrics["stick_area"] = {setting_.topology.stick_area, "R^2"};
  row.metrics["step_ms"] = {1e3 * double(setting_.dynamics.step), "ms"};
  row.identity.insert(programs_.begin(), programs_.end());
}

double Study::second(MassSprings& masses) const {
  const auto from = std::chrono::steady_clock::now();
  simulate(queue_, masses, setting_.dynamics, 1);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
}

}  // namespace pelage::springs
