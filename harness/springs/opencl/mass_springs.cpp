#include "harness/springs/opencl/mass_springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"

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
          "mass {} had diverged after step {} ({:.6g} s) of {} with the time step {} s and the stick stiffness {} N/m; use a shorter time step, more damping or softer springs",
          mass_number, step_number, double(step_number + 1) * double(d.step), d.solver.name, d.step,
          d.stiffness)),
      step(step_number),
      mass(mass_number) {}

MassSprings::MassSprings(const cl::Queue& queue, const SpringNetwork& network, const Dynamics& dynamics,
                         const MassSpringOptions& options)
    : lanes_(cl::lanes_of(queue.device().info(), options.lanes)),
      dynamics_((springs::check(dynamics), dynamics)),
      layout_(lay_out(network, dynamics.wind)),
      params_(springs::params(dynamics, network.length)) {
  const bool prisms = network.kind.shared_edges();
  if (dynamics.solver.implicit && dynamics.full_jacobian)
    throw InputError(
        "dynamics.springs.jacobian = \"full\": only the reference has it (--pipeline reference); use \"pruned\"");
  if (!dynamics.solver.newton && network.kind.edges)
    throw InputError(fmt::format("solver {}: not for springs between tops", dynamics.solver.name));
  const std::size_t places = layout_.places();
  const std::vector<std::int32_t> all_never(places, never);
  buffers_ = {{},
              cl::uploaded(queue, layout_.sites),
              cl::uploaded(queue, std::vector<float>(3 * places, 0.0f)),
              cl::uploaded(queue, layout_.offset),
              cl::uploaded(queue, std::vector<float>((prisms ? 4 : 3) * places, 0.0f)),
              cl::uploaded(queue, all_never),
              cl::Buffer<std::int32_t>(queue, std::span(all_never).first(1))};
  params_.sticks = int(network.sticks());
  const bool whole = options.whole == MassSpringOptions::Whole::always ||
                     (options.whole == MassSpringOptions::Whole::as_suits && options.blocks_per_item == 0 &&
                      whole_suits(queue.device().info(), network.kind, dynamics.solver, network.sticks()));
  if (prisms)
    prisms_.emplace(queue, layout_, dynamics, lanes_, whole, options);
  else
    blocks_.emplace(queue, layout_, dynamics, lanes_, whole, options);
}

// Uploads wind, gravity and the object's motion for many steps_ at once, because for a small model an upload
// would take as long as the launch.
void MassSprings::upload_moments(const cl::Queue& queue, int substeps) {
  if (known_from_ <= steps_ && steps_ + substeps <= known_to_) return;
  const int count = std::max(substeps, 512);
  const std::vector<Moment> table = moments(dynamics_, steps_, count);
  if (buffers_.moments.size() != table.size())
    buffers_.moments = cl::uploaded(queue, table);
  else
    buffers_.moments.write(queue, table);
  known_from_ = steps_;
  known_to_ = steps_ + count;
}

// Reads one vector per stick from a buffer with rows of four floats, or with three columns.
std::vector<glm::vec3> MassSprings::by_stick(const cl::Queue& queue, const cl::Buffer<float>& buffer,
                                             bool rows) const {
  const std::vector<float> value = buffer.read(queue);
  std::vector<glm::vec3> values;
  values.reserve(layout_.place.size());
  for (const std::size_t place : layout_.place) {
    const auto at = [&](std::size_t c) { return value[rows ? 4 * place + c : column_of(place, 3, c)]; };
    values.emplace_back(at(0), at(1), at(2));
  }
  return values;
}

void MassSprings::set(const cl::Queue& queue, const std::vector<glm::vec3>& offsets,
                      const std::vector<glm::vec3>& speeds, long steps) {
  const std::size_t sticks = layout_.place.size();
  if (offsets.size() != sticks || speeds.size() != sticks)
    throw InputError(
        fmt::format("state: {} offsets and {} speeds for {} sticks; all three counts must be equal",
                    offsets.size(), speeds.size(), sticks));
  if (steps < 0 || steps >= never)
    throw InputError(fmt::format("state: {} steps done; the number must be from 0 to 2^31 - 2", steps));
  std::vector<float> q = layout_.offset, v(buffers_.speed.size(), 0.0f);
  for (std::size_t i = 0; i < sticks; ++i) {
    if (!finite(offsets[i]) || !finite(speeds[i]))
      throw InputError(fmt::format("state of stick {}: all values must be finite numbers", i));
    const std::size_t place = layout_.place[i];
    for (std::size_t c = 0; c < 3; ++c) {
      q[column_of(place, 3, c)] = offsets[i][int(c)];
      v[prisms_ ? 4 * place + c : column_of(place, 3, c)] = speeds[i][int(c)];
    }
  }
  buffers_.offset.write(queue, q);
  buffers_.speed.write(queue, v);
  const std::vector<std::int32_t> all_never(layout_.places(), never);
  buffers_.diverged_at.write(queue, all_never);
  buffers_.first.write(queue, std::span(all_never).first(1));
  if (prisms_) prisms_->set(queue, layout_, q);
  steps_ = steps;
}

void MassSprings::retime(float step) {
  Dynamics other = dynamics_;
  other.step = step;
  springs::check(other);
  dynamics_ = other;
  params_.step = step;
  known_from_ = known_to_ = 0;
}

void MassSprings::set_forces(const cl::Queue& queue, const SpringNetwork& network, const Dynamics& dynamics) {
  springs::check(dynamics);
  dynamics_.gravity = dynamics.gravity;
  dynamics_.wind = dynamics.wind;
  known_from_ = known_to_ = 0;
  set_phases(network, dynamics_.wind, layout_);
  buffers_.sites.write(queue, layout_.sites);
}

void MassSprings::set_skin(const cl::Queue& queue, const SpringNetwork& network,
                           const std::vector<glm::vec3>& change) {
  Layout layout = lay_out(network, dynamics_.wind);
  if (layout.place != layout_.place || change.size() != layout_.place.size())
    throw InputError("moving skin: the sticks and springs must be those of the skin at rest");
  layout_ = std::move(layout);
  buffers_.sites.write(queue, layout_.sites);
  if (prisms_)
    prisms_->set_skin(queue, layout_, buffers_.offset.read(queue));
  else
    blocks_->set_skin(queue, layout_);
  if (!dynamics_.solver.newton) return;  // the velocities hold wind vectors
  std::vector<float> v = buffers_.speed.read(queue);
  for (std::size_t i = 0; i < change.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      v[prisms_ ? 4 * std::size_t(layout_.place[i]) + c : column_of(layout_.place[i], 3, c)] -=
          change[i][int(c)];
  buffers_.speed.write(queue, v);
}

void MassSprings::push(const cl::Queue& queue, const std::vector<glm::vec3>& force) {
  params_.pushed = 0;
  if (force.empty()) return;
  if (force.size() != layout_.place.size())
    throw InputError(fmt::format("local forces: {} forces for {} sticks; both counts must be equal",
                                 force.size(), layout_.place.size()));
  std::vector<float> columns(3 * layout_.places(), 0.0f);
  for (std::size_t i = 0; i < force.size(); ++i) {
    const glm::vec3 f = force[i];
    if (!finite(f))
      throw InputError(fmt::format(
          "local force on stick {}: ({}, {}, {}) N; all three components must be finite", i, f.x, f.y, f.z));
    for (std::size_t c = 0; c < 3; ++c) columns[column_of(layout_.place[i], 3, c)] = f[int(c)];
  }
  buffers_.push.write(queue, columns);
  params_.pushed = 1;
}

void MassSprings::enqueue(const cl::Queue& queue, int substeps, std::vector<cl::Event>* launches) {
  if (substeps <= 0) throw InputError(fmt::format("substeps: {}; the number must be at least 1", substeps));
  if (steps_ > never - 1 - substeps) throw InputError("substeps: a run has at most 2^31 steps in total");
  upload_moments(queue, substeps);
  TopologyParams params = params_;
  params.substeps = substeps;
  params.first_step = int(steps_);
  params.first_moment = int(2 * (steps_ - known_from_));
  if (contact_) {
    params.substeps = 1;
    for (int i = 0; i < substeps; ++i, ++params.first_step, params.first_moment += 2) {
      launch_steps(queue, params, launches);
      launch_contact(queue, i, launches);
    }
  } else {
    launch_steps(queue, params, launches);
  }
  steps_ += substeps;
}

void MassSprings::launch_steps(const cl::Queue& queue, const TopologyParams& params,
                               std::vector<cl::Event>* launches) {
  if (prisms_)
    prisms_->enqueue(queue, params, buffers_, launches);
  else
    blocks_->enqueue(queue, params, buffers_, launches);
}

void MassSprings::collide(const cl::Queue& queue, const Scene& scene, const ContactFields& fields) {
  cl::Program program(queue.device(), "springs/contact.cl",
                      fmt::format("{}{} -D PRISMS={}", build_options(lanes_, false),
                                  contact_options(scene.contact), int(prisms_.has_value())));
  cl::Kernel kernel(program, "contact_step");
  contact_ = Contact{ContactStage(queue, scene, fields), std::move(program), std::move(kernel)};
}

void MassSprings::launch_contact(const cl::Queue& queue, int time, std::vector<cl::Event>* launches) {
  cl::Kernel& kernel = contact_->kernel;
  const int units = int(layout_.places()) / lanes_;
  const ContactStage& stage = contact_->stage;
  if (prisms_)
    kernel.with(units, time, buffers_.sites, stage.table(), stage.field(), buffers_.offset, buffers_.speed,
                prisms_->tops(), int(prisms_->tops_on_skin()));
  else
    kernel.with(units, time, buffers_.sites, stage.table(), stage.field(), buffers_.offset, buffers_.speed);
  cl::Event event = kernel.enqueue(queue, std::size_t(units));
  if (launches) launches->push_back(std::move(event));
}

void MassSprings::check(const cl::Queue& queue) const {
  std::int32_t first = never;
  buffers_.first.read(queue, std::span(&first, 1));
  if (first == never) return;
  const std::vector<std::int32_t> at = buffers_.diverged_at.read(queue);
  std::int32_t step = never;
  std::size_t stick = 0;
  for (std::size_t i = 0; i < layout_.place.size(); ++i)
    if (at[layout_.place[i]] < step) step = at[layout_.place[i]], stick = i;
  if (step == never) return;  // only padding (sticks in unused places of the slices) diverged
  throw Diverged(step, layout_.place.size() + stick, dynamics_);
}

void MassSprings::advance(const cl::Queue& queue, int substeps) {
  enqueue(queue, substeps);
  check(queue);
}

std::vector<glm::vec3> MassSprings::offsets(const cl::Queue& queue) const {
  return by_stick(queue, buffers_.offset, false);
}

std::vector<glm::vec3> MassSprings::speeds(const cl::Queue& queue) const {
  return by_stick(queue, buffers_.speed, prisms_.has_value());
}

std::vector<std::int32_t> MassSprings::offset_columns() const {
  std::vector<std::int32_t> columns;
  columns.reserve(layout_.place.size());
  for (const std::uint32_t place : layout_.place) columns.push_back(std::int32_t(column_of(place, 3, 0)));
  return columns;
}

std::size_t MassSprings::bytes() const {
  const Buffers& b = buffers_;
  return bytes_of(b.sites) + bytes_of(b.push) + bytes_of(b.offset) + bytes_of(b.speed) +
         bytes_of(b.diverged_at) + bytes_of(b.first) + (prisms_ ? prisms_->bytes() : blocks_->bytes());
}

const LinearSolves& MassSprings::solves() const {
  static const LinearSolves none;
  return prisms_ ? prisms_->solves() : none;
}

const cl::Program& MassSprings::program() const {
  return prisms_ ? prisms_->program() : blocks_->program();
}

namespace {

using Vectors = std::vector<glm::vec3>;

/// Returns the 99th percentile of the distances between a[i] and b[i], as a fraction of `length`.
double difference(const Vectors& a, const Vectors& b, float length) {
  std::vector<double> error;
  error.reserve(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    error.push_back(glm::distance(glm::dvec3(a[i]), glm::dvec3(b[i])) / double(length));
  const auto at = error.begin() + std::ptrdiff_t((error.size() - 1) * 99 / 100);
  std::nth_element(error.begin(), at, error.end());
  return *at;
}

}  // namespace

AdaptiveSteps::AdaptiveSteps(float span, int steps, float tolerance, int most)
    : span_(span), tolerance_(tolerance), steps_(steps), most_(most) {
  if (!(span > 0) || !(tolerance > 0) || steps < 1 || steps > most)
    throw InputError(fmt::format(
        "adaptive steps: frame length {} s, {} steps, tolerance {}, at most {} steps; frame length and tolerance must be above 0, and the number of steps must be from 1 to the limit",
        span, steps, tolerance, most));
}

AdaptiveSteps::Frame AdaptiveSteps::advance(const cl::Queue& queue, MassSprings& masses,
                                            std::vector<cl::Event>* launches) {
  const Vectors offsets = masses.offsets(queue), speeds = masses.speeds(queue);
  const auto moved = [&](int steps) {
    masses.retime(span_ / float(steps));
    masses.set(queue, offsets, speeds, frame_ * steps);
    masses.enqueue(queue, steps, launches);
    masses.check(queue);
    return masses.offsets(queue);
  };
  // Computes one frame in `steps` steps. If the masses diverge, returns an empty result, so that advance()
  // tries more steps.
  const auto tried = [&](int steps) {
    try {
      return moved(steps);
    } catch (const Diverged&) {
      if (steps >= most_) throw;
      return Vectors{};
    }
  };
  Vectors coarse = tried(steps_);
  for (;;) {
    if (2 * steps_ > most_)
      throw InputError(fmt::format(
          "the tolerance {} needs more than {} time steps per frame; use a larger tolerance or a shorter frame",
          tolerance_, most_));
    Vectors fine = tried(2 * steps_);
    const double error = coarse.empty() || fine.empty() ? std::numeric_limits<double>::infinity()
                                                        : difference(coarse, fine, masses.length());
    if (error <= double(tolerance_)) {
      const Frame frame{2 * steps_, error};
      if (error < 0.25 * double(tolerance_)) steps_ = std::max(1, steps_ / 2);
      ++frame_;
      return frame;
    }
    steps_ *= 2;
    coarse = std::move(fine);
  }
}

}  // namespace pelage::springs
