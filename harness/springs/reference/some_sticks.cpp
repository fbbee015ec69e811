
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "harness/contact/reference/colliders.hpp"
#include "harness/error.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/reference/reference.hpp"

namespace pelage::springs {
namespace {

constexpr std::uint32_t absent = std::numeric_limits<std::uint32_t>::max();

// Returns the part of the network that consists of the given sticks and the springs between these sticks. The
// indices in `sticks` are in ascending order.
springs::SpringNetwork part_of(const SpringNetwork& whole, const std::vector<std::uint32_t>& sticks) {
  SpringNetwork part;
  part.kind = whole.kind;
  part.length = whole.length;
  part.stick_area = whole.stick_area;
  const auto count = std::uint32_t(sticks.size());
  std::vector<std::uint32_t> number(whole.mass.size(), absent);
  for (const bool tops : {false, true})
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::size_t mass = tops ? whole.top(sticks[i]) : sticks[i];
      number[mass] = std::uint32_t(part.mass.size());
      part.mass.push_back(whole.mass[mass]);
    }
  for (const std::uint32_t stick : sticks) {
    part.normal.push_back(whole.normal[stick]);
    part.copy.push_back(whole.copy[stick]);
    part.point.push_back(whole.point[stick]);
    part.gust_at.push_back(whole.gust_at[stick]);
  }
  for (std::size_t k = 0; k < whole.spring.size(); ++k) {
    const glm::uvec2 ends(number[whole.spring[k].x], number[whole.spring[k].y]);
    if (ends.x == absent || ends.y == absent) continue;
    part.spring.push_back(ends);
    part.rest.push_back(whole.rest[k]);
  }
  return part;
}

std::vector<std::uint32_t> spread(const SpringNetwork& network, std::size_t count) {
  std::vector<std::uint32_t> found;
  const std::size_t all = network.sticks();
  if (network.kind.shared_edges() || count >= all) {
    found.resize(all);
    std::iota(found.begin(), found.end(), 0u);
    return found;
  }
  // In separable topologies the three sticks of a triangle are selected together.
  const std::size_t together = network.kind.separable ? 3 : 1, groups = all / together;
  const std::size_t wanted = std::clamp<std::size_t>(count / together, 1, groups);
  for (std::size_t i = 0; i < wanted; ++i)
    for (std::size_t c = 0; c < together; ++c)
      found.push_back(std::uint32_t(i * groups / wanted * together + c));
  return found;
}

/// Moves the tops out of the colliders at a time, in s.
void push_out(const FrameInput& input, const SpringNetwork& network, double time, reference::State& state) {
  const pelage::reference::Colliders colliders(input.scene, input.contact_fields, time);
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    const std::size_t top = network.top(i);
    const glm::dvec3 root = state.position[i];
    const pelage::reference::Pushed pushed = colliders.push({state.position[top] - root, state.velocity[top]},
                                                            root, glm::dvec3(network.normal[i]));
    state.position[top] = root + pushed.place;
    state.velocity[top] = pushed.velocity;
  }
}

/// Moves a part of the sticks of `whole` by frames `first` to `first` + `frames` - 1 with the forces `scene`.
/// `velocity` is that of the bases of all sticks; empty: the skin does not move.
reference::State moved_part(const SpringNetwork& whole, const FrameInput& input, const Mesh& mesh,
                            const SpringNetwork& part, const std::vector<std::uint32_t>& sticks,
                            const DynamicsScene& scene, reference::State state, int first, int frames,
                            const std::vector<glm::dvec3>& velocity = {}) {
  std::vector<glm::vec3> push = pushes(whole, mesh, scene.poke);
  if (!velocity.empty()) push = with_drag(std::move(push), velocity, dynamics_of(scene, whole).drag);
  std::vector<glm::dvec3> own;
  if (!push.empty())
    for (const std::uint32_t stick : sticks) own.emplace_back(push[stick]);
  const Dynamics dynamics = dynamics_of(scene, part);
  const reference::System system{part, dynamics, std::move(own)};
  const long begin = long(first) * scene.substeps, steps = long(frames) * scene.substeps;
  if (!has_contact(input.scene.contact)) return reference::after(system, std::move(state), begin, steps);
  for (long i = begin; i < begin + steps; ++i) {
    state = reference::step(system, state, i);
    push_out(input, part, double(i + 1) * double(scene.step), state);
  }
  return state;
}

/// Moves the sticks `sticks` on a skin that deforms by `frames` frames from rest. Stores their last state in
/// `state`, and returns their part of the last network.
SpringNetwork moved_on_skin(const FrameInput& input, const SpringNetwork& first,
                            const std::vector<std::uint32_t>& sticks, int frames, reference::State& state) {
  SpringNetwork part = part_of(first, sticks);
  std::vector<glm::dvec3> before(first.sticks(), glm::dvec3(0));
  for (int i = 0; i < frames; ++i) {
    const MovedSticks moved = moved_sticks(input, first, i);
    part = part_of(moved.network, sticks);
    std::vector<glm::dvec3> change;
    change.reserve(sticks.size());
    for (const std::uint32_t stick : sticks)
      change.push_back(solver_of(input.scene.dynamics.solver).newton ? moved.velocity[stick] - before[stick]
                                                                     : glm::dvec3(0));
    state = reference::on_new_skin(part, std::move(state), change);
    state = moved_part(moved.network, input, moved.mesh, part, sticks, dynamics_of_frame(input.scene, i),
                       std::move(state), i, 1, moved.velocity);
    before = moved.velocity;
  }
  return part;
}

}  // namespace

SomeSticks some_reference_sticks(const FrameInput& input, int frames, std::size_t count,
                                 const std::function<void(const std::vector<glm::dvec3>&)>& each) {
  const Scene& scene = input.scene;
  if (scene.dynamics.tolerance > 0)
    throw InputError(fmt::format(
        "dynamics.tolerance = {}: the reference always computes `substeps` steps per frame; comparisons with it (pelage run, pelage check) need dynamics.tolerance = 0",
        scene.dynamics.tolerance));
  const SpringNetwork network = network_of(input);
  SomeSticks some{spread(network, count), {}, {}};
  SpringNetwork part = part_of(network, some.stick);
  const auto moved = [&](const DynamicsScene& forces, reference::State from, int first, int number) {
    return moved_part(network, input, *input.mesh, part, some.stick, forces, std::move(from), first, number);
  };
  reference::State state = reference::rest(part);
  if (!input.mesh->frames.empty())
    part = moved_on_skin(input, network, some.stick, frames, state);
  else if (!forces_change(scene) && !each)
    state = moved(scene.dynamics, std::move(state), 0, frames);
  else
    for (int i = 0; i < frames; ++i) {
      state = moved(dynamics_of_frame(scene, i), std::move(state), i, 1);
      if (each) each(reference::offsets(part, state));
    }
  some.offset = reference::offsets(part, state);
  for (std::size_t i = 0; i < part.sticks(); ++i) some.velocity.push_back(state.velocity[part.top(i)]);
  return some;
}

}  // namespace pelage::springs
