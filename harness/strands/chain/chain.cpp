#include "harness/strands/chain/chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/error.hpp"

namespace pelage::strands {
namespace {

constexpr std::size_t slice = 16;
constexpr double escape_time = 1.0 / 30;  // T of docs/strands.md, section Body, s

void in_range(const char* what, float value, float least, float most) {
  if (!(value >= least && value <= most))  // also true for NaN
    throw InputError(fmt::format("{}: {}; it must be from {} to {}", what, value, least, most));
}

bool finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void unit(const char* what, glm::vec3 v) {
  if (!(std::abs(glm::length(v) - 1) < 1e-4f))
    throw InputError(fmt::format("{}: ({}, {}, {}); it must be a unit vector", what, v.x, v.y, v.z));
}

std::size_t column_of(std::size_t strand, std::size_t columns, std::size_t column) {
  return (strand / slice * columns + column) * slice + strand % slice;
}

std::size_t slices_of(std::size_t strands) {
  return (strands + slice - 1) / slice;
}

float cosine(float degrees) {
  return float(std::cos(double(degrees) * std::numbers::pi / 180));
}

ChainMoment moment(const ChainDynamics& d, double time) {
  const springs::Pose pose = springs::pose_at(d.motion, time);
  const glm::dvec3 air = double(d.wind.speed) * glm::normalize(glm::dvec3(d.wind.direction));
  const glm::vec3 fall(glm::dvec3(d.gravity) - pose.acceleration), relative(air - pose.velocity),
      gust(double(d.wind.gust) * air), turn(pose.rate * pose.axis), turn_up(pose.rate_up * pose.axis);
  const auto column = [&](glm::dvec3 v) { return glm::vec3(springs::turned(v, pose.axis, pose.angle)); };
  const glm::vec3 x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
  const double phase = 2 * std::numbers::pi * double(d.wind.frequency) * time;
  return {.fall_x = fall.x,
          .fall_y = fall.y,
          .fall_z = fall.z,
          .air_x = relative.x,
          .air_y = relative.y,
          .air_z = relative.z,
          .gust_x = gust.x,
          .gust_y = gust.y,
          .gust_z = gust.z,
          .gust_sin = float(std::sin(phase)),
          .gust_cos = float(std::cos(phase)),
          .turn_x = turn.x,
          .turn_y = turn.y,
          .turn_z = turn.z,
          .turn_up_x = turn_up.x,
          .turn_up_y = turn_up.y,
          .turn_up_z = turn_up.z,
          .x_x = x.x,
          .x_y = x.y,
          .x_z = x.z,
          .y_x = y.x,
          .y_y = y.y,
          .y_z = y.z,
          .z_x = z.x,
          .z_y = z.y,
          .z_z = z.z};
}

}  // namespace

void check(const ChainDynamics& d) {
  // With a time step shorter than 1e-4 s, the rotation of a slow strand in one step is smaller than the
  // rounding error of its direction, and the strand stops moving.
  in_range("time step of the strands (s)", d.step, 1e-4f, 1);
  in_range("length of the first segment (as a fraction of the strand's length)", d.first_segment, 0.05f,
           0.95f);
  in_range("mass at the tip (as a fraction of the strand's mass)", d.tip_mass, 0.05f, 0.95f);
  in_range("drag of the strands (1/s)", d.drag, 0, 1e4f);
  in_range("damping of the first segment (1/s)", d.damping_first, 0, 1e4f);
  in_range("damping of the second segment (1/s)", d.damping_second, 0, 1e4f);
  if (!finite(d.gravity)) throw InputError("gravity (R/s^2): all three components must be finite");
  if (!d.body) return;
  const glm::ivec3 n = d.body->nodes;
  if (n.x < 2 || n.y < 2 || n.z < 2 || !(d.body->cell > 0) ||
      d.body->distance.size() != std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z))
    throw InputError("distance field of the body: it must have at least 2 nodes along each axis");
}

bool has_own_damping(const std::vector<Chain>& chains) {
  return std::ranges::any_of(chains, [](const Chain& c) { return c.drag != 1 || c.damping != 1; });
}

ChainParams params(const ChainDynamics& d) {
  const double l1 = double(d.first_segment), l2 = 1 - l1, m2 = double(d.tip_mass);
  const double c = double(d.drag), d1 = double(d.damping_first), d2 = double(d.damping_second);
  ChainParams p{};
  p.first = float(l1);
  p.second = float(l2);
  p.inertia_first = float(l1 * l1);  // m1 + m2 = 1
  p.inertia_second = float(m2 * l2 * l2);
  p.inertia_both = float(m2 * l1 * l2);
  p.lever_first = float(l1);
  p.lever_second = float(m2 * l2);
  p.air_first = float(c * l1);
  p.air_second = float(c * m2 * l2);
  p.drag_first = float(c * l1 * l1);
  p.drag_second = float(c * m2 * l2 * l2);
  p.drag_both = float(c * m2 * l1 * l2);
  p.joint_damping = float(d1 + d2);
  p.tip_damping = float(d2);
  p.damping_first = float(c * l1 * l1 + d1 + d2);
  p.damping_second = float(c * m2 * l2 * l2 + d2);
  p.damping_both = float(c * m2 * l1 * l2 - d2);
  p.step = d.step;
  if (d.body) {
    p.field_x = d.body->origin.x, p.field_y = d.body->origin.y, p.field_z = d.body->origin.z;
    p.nodes_x = d.body->nodes.x, p.nodes_y = d.body->nodes.y, p.nodes_z = d.body->nodes.z;
    p.per_cell = 1 / d.body->cell;
    p.escape = float(std::min(1.0, double(d.step) / escape_time));
  }
  return p;
}

std::vector<ChainMoment> moments(const ChainDynamics& dynamics, long first, int count) {
  std::vector<ChainMoment> found;
  found.reserve(std::size_t(count));
  for (int i = 0; i < count; ++i)
    found.push_back(moment(dynamics, double(first + 1 + i) * double(dynamics.step)));
  return found;
}

std::vector<float> strand_columns(const std::vector<Chain>& chains, const springs::Wind& wind) {
  std::vector<float> table(slices_of(chains.size()) * slice * STRAND_COLUMNS);
  for (std::size_t i = 0; i < slices_of(chains.size()) * slice; ++i) {
    const Chain chain = i < chains.size() ? chains[i] : Chain{};
    if (!finite(chain.root)) throw InputError("root of a strand: all three components must be finite");
    unit("rest direction of a strand", chain.rest);
    unit("normal of the skin", chain.normal);
    if (!(glm::dot(chain.rest, chain.normal) >= 0))
      throw InputError("rest direction of a strand: it must not point below the skin");
    in_range("length of a strand (R)", chain.length, 1e-4f, 10);
    in_range("stiffness of a strand's first segment (1/s^2)", chain.stiffness_first, 0, 1e8f);
    in_range("stiffness of a strand's second segment (1/s^2)", chain.stiffness_second, 0, 1e8f);
    in_range("largest angle of a strand's first segment (degrees)", chain.limit_first, 1, 180);
    in_range("largest angle of a strand's second segment (degrees)", chain.limit_second, 1, 180);
    in_range("factor of a strand's drag", chain.drag, 0, 100);
    in_range("factor of a strand's damping", chain.damping, 0, 100);
    const double phase = springs::gust_phase(wind, chain.root);
    const auto put = [&](int column, float value) {
      table[column_of(i, STRAND_COLUMNS, std::size_t(column))] = value;
    };
    for (int c = 0; c < 3; ++c) {
      put(STRAND_ROOT + c, chain.root[c]);
      put(STRAND_REST + c, chain.rest[c]);
      put(STRAND_NORMAL + c, chain.normal[c]);
    }
    put(STRAND_SHORTNESS, 1 / chain.length);
    put(STRAND_STIFF_FIRST, chain.stiffness_first);
    put(STRAND_STIFF_SECOND, chain.stiffness_second);
    put(STRAND_LIMIT_FIRST, cosine(chain.limit_first));
    put(STRAND_LIMIT_SECOND, cosine(chain.limit_second));
    put(STRAND_PHASE_COS, float(std::cos(phase)));
    put(STRAND_PHASE_SIN, float(std::sin(phase)));
    put(STRAND_DRAG, chain.drag);
    put(STRAND_DAMPING, chain.damping);
  }
  return table;
}

std::vector<float> body_columns(const std::vector<Chain>& chains, const ChainDynamics& dynamics,
                                const std::vector<ChainState>& states) {
  std::vector<float> table(slices_of(chains.size()) * slice * BODY_COLUMNS);
  for (std::size_t i = 0; dynamics.body && i < slices_of(chains.size()) * slice; ++i) {
    const auto put = [&](int column, float value) {
      table[column_of(i, BODY_COLUMNS, std::size_t(column))] = value;
    };
    if (i >= chains.size()) {  // an unused place never touches the body
      put(BODY_JOINT_ALLOWED, 1e3f);
      put(BODY_TIP_ALLOWED, 1e3f);
      continue;
    }
    const auto allowed = [&](float height) {
      const glm::dvec3 point =
          glm::dvec3(chains[i].root) + double(height * chains[i].length) * glm::dvec3(chains[i].rest);
      return float(std::max(0.0, -value_at(*dynamics.body, point)));
    };
    put(BODY_JOINT_ALLOWED, allowed(dynamics.first_segment));
    put(BODY_TIP_ALLOWED, allowed(1));
    put(BODY_STOP, states[i].body[0]);
    put(BODY_STOP + 1, states[i].body[1]);
  }
  return table;
}

std::vector<float> skin_columns(const SkinFrame& frame, std::size_t strands) {
  for (const auto* list : {&frame.root, &frame.velocity, &frame.acceleration, &frame.rest, &frame.normal})
    if (list->size() != strands)
      throw InputError(fmt::format("frame of the skin: {} values for {} strands; both counts must be equal",
                                   list->size(), strands));
  std::vector<float> table(slices_of(strands) * slice * STRAND_COLUMNS);
  for (std::size_t i = 0; i < slices_of(strands) * slice; ++i) {
    const auto put = [&](int first, glm::vec3 v) {
      for (int c = 0; c < 3; ++c)
        table[column_of(i, STRAND_COLUMNS, std::size_t(first) + std::size_t(c))] = v[c];
    };
    const bool used = i < strands;
    put(STRAND_REST, used ? frame.rest[i] : Chain{}.rest);
    put(STRAND_NORMAL, used ? frame.normal[i] : Chain{}.normal);
    if (!used) continue;
    if (!finite(frame.root[i]) || !finite(frame.velocity[i]) || !finite(frame.acceleration[i]))
      throw InputError("frame of the skin: all positions, velocities and accelerations must be finite");
    unit("rest direction of a strand", frame.rest[i]);
    unit("normal of the skin", frame.normal[i]);
    put(STRAND_ROOT, frame.root[i]);
    put(SKIN_VELOCITY, frame.velocity[i]);
    put(SKIN_ACCELERATION, frame.acceleration[i]);
  }
  return table;
}

ChainState at_rest(const Chain& chain) {
  return {.direction = {chain.rest, chain.rest}, .rate = {}, .stop = {}, .body = {}};
}

std::vector<float> state_columns(const std::vector<ChainState>& states) {
  std::vector<float> table(slices_of(states.size()) * slice * CHAIN_COLUMNS);
  for (std::size_t i = 0; i < slices_of(states.size()) * slice; ++i) {
    const ChainState state = i < states.size() ? states[i] : at_rest({});
    const auto put = [&](int column, float value) {
      table[column_of(i, CHAIN_COLUMNS, std::size_t(column))] = value;
    };
    for (int c = 0; c < 3; ++c) {
      put(CHAIN_FIRST + c, state.direction[0][c]);
      put(CHAIN_SECOND + c, state.direction[1][c]);
      put(CHAIN_FIRST_RATE + c, state.rate[0][c]);
      put(CHAIN_SECOND_RATE + c, state.rate[1][c]);
    }
    for (int c = 0; c < 4; ++c) put(CHAIN_STOP + c, state.stop[std::size_t(c)]);
  }
  return table;
}

std::vector<ChainState> states_of(const std::vector<float>& table, std::size_t strands) {
  std::vector<ChainState> states(strands);
  for (std::size_t i = 0; i < strands; ++i) {
    const auto at = [&](int column) { return table[column_of(i, CHAIN_COLUMNS, std::size_t(column))]; };
    const auto vector = [&](int first) { return glm::vec3(at(first), at(first + 1), at(first + 2)); };
    states[i].direction = {vector(CHAIN_FIRST), vector(CHAIN_SECOND)};
    states[i].rate = {vector(CHAIN_FIRST_RATE), vector(CHAIN_SECOND_RATE)};
    for (int c = 0; c < 4; ++c) states[i].stop[std::size_t(c)] = at(CHAIN_STOP + c);
  }
  return states;
}

}  // namespace pelage::strands
