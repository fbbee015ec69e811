#include "harness/springs/opencl/mass_springs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "harness/error.hpp"
#include "harness/springs/opencl/stages.hpp"

namespace pelage::springs {
namespace {

constexpr std::int32_t never = std::numeric_limits<std::int32_t>::max();

bool finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

template <class T>
std::size_t bytes_of(const cl::Buffer<T>& buffer) {
  return buffer.size() * sizeof(T);
}

}  // namespace

Diverged::Diverged(long step_number, std::size_t mass_number, const Dynamics& d)
    : std::runtime_error(fmt::format(
          "mass {} had diverged after step {} ({:.6g} s) of {} with the time step {} s and the stick "
          "stiffness {} N/m; use a shorter time step, more damping or softer springs",
          mass_number, step_number, double(step_number + 1) * double(d.step), name(d.solver), d.step,
          d.stiffness)),
      step(step_number),
      mass(mass_number) {}

struct MassSprings::State {
  Dynamics dynamics;
  Layout layout;
  int lanes;
  TopologyParams params;
  Buffers buffers;
  std::optional<BlockStage> blocks;
  std::optional<PrismStage> prisms;
  long steps = 0;
  // The device holds wind, gravity and the object's motion for the steps from known_from to known_to - 1.
  long known_from = 0, known_to = 0;

  // Uploads wind, gravity and the object's motion for many steps at once, because for a small model an upload
  // would take as long as the launch.
  void know_moments(const cl::Queue& queue, int substeps) {
    if (known_from <= steps && steps + substeps <= known_to) return;
    const int count = std::max(substeps, 512);
    const std::vector<Moment> table = moments(dynamics, steps, count);
    if (buffers.moments.size() != table.size())
      buffers.moments = cl::uploaded(queue, table);
    else
      buffers.moments.write(queue, table);
    known_from = steps;
    known_to = steps + count;
  }

  // Reads one vector per stick from a buffer with rows of four floats, or with three columns.
  std::vector<glm::vec3> by_stick(const cl::Queue& queue, const cl::Buffer<float>& buffer, bool rows) const {
    const std::vector<float> value = buffer.read(queue);
    std::vector<glm::vec3> values;
    values.reserve(layout.place.size());
    for (const std::size_t place : layout.place) {
      const auto at = [&](std::size_t c) { return value[rows ? 4 * place + c : column_of(place, 3, c)]; };
      values.emplace_back(at(0), at(1), at(2));
    }
    return values;
  }
};

MassSprings::MassSprings(const cl::Queue& queue, const SpringNetwork& topology, const Dynamics& dynamics,
                         const MassSpringOptions& options) {
  springs::check(dynamics);
  const int lanes = cl::lanes_of(queue.device().info(), options.lanes);
  Layout layout = lay_out(topology, dynamics.wind);
  const bool prisms = topology.kind.shared_edges();
  if (dynamics.solver.implicit && dynamics.full_jacobian)
    throw InputError(
        "dynamics.springs.jacobian = \"full\": only the reference has it (--pipeline reference); use "
        "\"pruned\"");
  const std::size_t places = layout.places();
  const std::vector<std::int32_t> all_never(places, never);
  Buffers buffers{{},
                  cl::uploaded(queue, layout.sites),
                  cl::uploaded(queue, std::vector<float>(3 * places, 0.0f)),
                  cl::uploaded(queue, layout.offset),
                  cl::uploaded(queue, std::vector<float>((prisms ? 4 : 3) * places, 0.0f)),
                  cl::uploaded(queue, all_never),
                  cl::Buffer<std::int32_t>(queue, std::span(all_never).first(1))};
  state_ = std::make_unique<State>(State{dynamics,
                                         std::move(layout),
                                         lanes,
                                         springs::params(dynamics, topology.length),
                                         std::move(buffers),
                                         {},
                                         {},
                                         0});
  State& s = *state_;
  s.params.sticks = int(topology.sticks());
  const bool whole = options.whole == MassSpringOptions::Whole::always ||
                     (options.whole == MassSpringOptions::Whole::as_suits && options.blocks_per_item == 0 &&
                      whole_suits(queue.device().info(), topology.kind, dynamics.solver, topology.sticks()));
  if (prisms)
    s.prisms.emplace(queue, s.layout, dynamics, lanes, whole, options);
  else
    s.blocks.emplace(queue, s.layout, dynamics, lanes, whole, options);
}
MassSprings::~MassSprings() = default;
MassSprings::MassSprings(MassSprings&&) noexcept = default;
MassSprings& MassSprings::operator=(MassSprings&&) noexcept = default;

void MassSprings::set(const cl::Queue& queue, const std::vector<glm::vec3>& offsets,
                      const std::vector<glm::vec3>& speeds, long steps) {
  State& s = *state_;
  const std::size_t sticks = s.layout.place.size();
  if (offsets.size() != sticks || speeds.size() != sticks)
    throw InputError(
        fmt::format("state: {} offsets and {} speeds for {} sticks; all three counts must be equal",
                    offsets.size(), speeds.size(), sticks));
  if (steps < 0 || steps >= never)
    throw InputError(fmt::format("state: {} steps done; the number must be from 0 to 2^31 - 2", steps));
  std::vector<float> q = s.layout.offset, v(s.buffers.speed.size(), 0.0f);
  for (std::size_t i = 0; i < sticks; ++i) {
    if (!finite(offsets[i]) || !finite(speeds[i]))
      throw InputError(fmt::format("state of stick {}: all values must be finite numbers", i));
    const std::size_t place = s.layout.place[i];
    for (std::size_t c = 0; c < 3; ++c) {
      q[column_of(place, 3, c)] = offsets[i][int(c)];
      v[s.prisms ? 4 * place + c : column_of(place, 3, c)] = speeds[i][int(c)];
    }
  }
  s.buffers.offset.write(queue, q);
  s.buffers.speed.write(queue, v);
  const std::vector<std::int32_t> all_never(s.layout.places(), never);
  s.buffers.diverged_at.write(queue, all_never);
  s.buffers.first.write(queue, std::span(all_never).first(1));
  if (s.prisms) s.prisms->set(queue, s.layout, q);
  s.steps = steps;
}

void MassSprings::retime(float step) {
  State& s = *state_;
  Dynamics other = s.dynamics;
  other.step = step;
  springs::check(other);
  s.dynamics = other;
  s.params.step = step;
  s.known_from = s.known_to = 0;
}

void MassSprings::push(const cl::Queue& queue, const std::vector<glm::vec3>& force) {
  State& s = *state_;
  s.params.pushed = 0;
  if (force.empty()) return;
  if (force.size() != s.layout.place.size())
    throw InputError(fmt::format("local forces: {} forces for {} sticks; both counts must be equal",
                                 force.size(), s.layout.place.size()));
  std::vector<float> columns(3 * s.layout.places(), 0.0f);
  for (std::size_t i = 0; i < force.size(); ++i) {
    const glm::vec3 f = force[i];
    if (!finite(f))
      throw InputError(fmt::format(
          "local force on stick {}: ({}, {}, {}) N; all three components must be finite", i, f.x, f.y, f.z));
    for (std::size_t c = 0; c < 3; ++c) columns[column_of(s.layout.place[i], 3, c)] = f[int(c)];
  }
  s.buffers.push.write(queue, columns);
  s.params.pushed = 1;
}

void MassSprings::enqueue(const cl::Queue& queue, int substeps, std::vector<cl::Event>* launches) {
  State& s = *state_;
  if (substeps <= 0) throw InputError(fmt::format("substeps: {}; the number must be at least 1", substeps));
  if (s.steps > never - 1 - substeps) throw InputError("substeps: a run has at most 2^31 steps in total");
  s.know_moments(queue, substeps);
  TopologyParams params = s.params;
  params.substeps = substeps;
  params.first_step = int(s.steps);
  params.first_moment = int(2 * (s.steps - s.known_from));
  if (s.prisms)
    s.prisms->enqueue(queue, params, s.buffers, launches);
  else
    s.blocks->enqueue(queue, params, s.buffers, launches);
  s.steps += substeps;
}

void MassSprings::check(const cl::Queue& queue) const {
  const State& s = *state_;
  std::int32_t first = never;
  s.buffers.first.read(queue, std::span(&first, 1));
  if (first == never) return;
  const std::vector<std::int32_t> at = s.buffers.diverged_at.read(queue);
  std::int32_t step = never;
  std::size_t stick = 0;
  for (std::size_t i = 0; i < s.layout.place.size(); ++i)
    if (at[s.layout.place[i]] < step) step = at[s.layout.place[i]], stick = i;
  if (step == never) return;  // only padding (sticks in unused places of the slices) diverged
  throw Diverged(step, s.layout.place.size() + stick, s.dynamics);
}

void MassSprings::advance(const cl::Queue& queue, int substeps) {
  enqueue(queue, substeps);
  check(queue);
}

std::vector<glm::vec3> MassSprings::offsets(const cl::Queue& queue) const {
  return state_->by_stick(queue, state_->buffers.offset, false);
}

std::vector<glm::vec3> MassSprings::speeds(const cl::Queue& queue) const {
  return state_->by_stick(queue, state_->buffers.speed, state_->prisms.has_value());
}

const cl::Buffer<float>& MassSprings::offset() const {
  return state_->buffers.offset;
}

std::vector<std::int32_t> MassSprings::offset_columns() const {
  std::vector<std::int32_t> columns;
  columns.reserve(state_->layout.place.size());
  for (const std::uint32_t place : state_->layout.place)
    columns.push_back(std::int32_t(column_of(place, 3, 0)));
  return columns;
}

float MassSprings::length() const {
  return state_->params.length;
}

long MassSprings::steps() const {
  return state_->steps;
}

std::size_t MassSprings::bytes() const {
  const Buffers& b = state_->buffers;
  return bytes_of(b.sites) + bytes_of(b.push) + bytes_of(b.offset) + bytes_of(b.speed) +
         bytes_of(b.diverged_at) + bytes_of(b.first) +
         (state_->prisms ? state_->prisms->bytes() : state_->blocks->bytes());
}

const LinearSolves& MassSprings::solves() const {
  static const LinearSolves none;
  return state_->prisms ? state_->prisms->solves() : none;
}

const cl::Program& MassSprings::program() const {
  return state_->prisms ? state_->prisms->program() : state_->blocks->program();
}

}  // namespace pelage::springs
