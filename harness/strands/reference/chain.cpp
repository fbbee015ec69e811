// The double-precision reference for the simulation of strands. The items 1 to 6 in the comments are those of
// the list in docs/strands.md, section "Time step".
#include "harness/strands/reference/chain.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace pelage::strands::reference {
namespace {

using springs::turned;
using Vec = glm::dvec3;
using Pair = Eigen::Matrix<double, 6, 1>;        // the rates of both segments, or forces on both
using PairMatrix = Eigen::Matrix<double, 6, 6>;  // a linear map from a Pair to a Pair
using FourPairs = Eigen::Matrix<double, 6, 4>;   // one pair in each column
using Pairs = Eigen::Matrix<double, 6, 6>;       // one pair in each column
using FourPairsT = Eigen::Matrix<double, 4, 6>;  // one pair in each row

Pair pair(Vec first, Vec second) {
  Pair p;
  p << first.x, first.y, first.z, second.x, second.y, second.z;
  return p;
}
Vec first(const Pair& p) {
  return {p[0], p[1], p[2]};
}
Vec second(const Pair& p) {
  return {p[3], p[4], p[5]};
}

// The values of the symbols of docs/strands.md at one time.
struct Model {
  double l1, l2, m1, m2, c1, c2, d1, d2, k1, k2;
  double inertia_u, inertia_w, inertia_uw;  // A, B, C
  double limit1, limit2;                    // rad
  Vec d, n;
  Vec gu, gw;  // Gu, Gw
};

Model model_at(const Chain& chain, const ChainDynamics& dynamics, double time,
               const SkinPoint* skin = nullptr) {
  Model m{};
  m.l1 = double(dynamics.first_segment);
  m.l2 = 1 - m.l1;
  m.m2 = double(dynamics.tip_mass);
  m.m1 = 1 - m.m2;
  m.c1 = m.m1 * double(chain.drag) * double(dynamics.drag);
  m.c2 = m.m2 * double(chain.drag) * double(dynamics.drag);
  m.d1 = double(chain.damping) * double(dynamics.damping_first);
  m.d2 = double(chain.damping) * double(dynamics.damping_second);
  m.k1 = double(chain.stiffness_first);
  m.k2 = double(chain.stiffness_second);
  m.inertia_u = (m.m1 + m.m2) * m.l1 * m.l1;
  m.inertia_w = m.m2 * m.l2 * m.l2;
  m.inertia_uw = m.m2 * m.l1 * m.l2;
  m.limit1 = glm::radians(double(chain.limit_first));
  m.limit2 = glm::radians(double(chain.limit_second));

  const springs::Pose pose = springs::pose_at(dynamics.motion, time);
  const auto to_world = [&](glm::vec3 v) { return turned(Vec(v), pose.axis, pose.angle); };
  m.d = glm::normalize(skin ? skin->rest : to_world(chain.rest));
  m.n = glm::normalize(skin ? skin->normal : to_world(chain.normal));

  const Vec x = to_world(chain.root), o = pose.rate * pose.axis, o_1 = pose.rate_up * pose.axis;
  const Vec root_velocity = skin ? skin->velocity : pose.velocity + glm::cross(o, x);
  const Vec root_acceleration =
      skin ? skin->acceleration : pose.acceleration + glm::cross(o_1, x) + glm::cross(o, glm::cross(o, x));

  const springs::Wind& wind = dynamics.wind;
  constexpr double tau = 2 * std::numbers::pi;
  const Vec e = glm::normalize(Vec(wind.direction));
  const double phase = tau * glm::dot(Vec(chain.root), e) / double(wind.wavelength);
  const double gust = double(wind.gust) * std::sin(tau * double(wind.frequency) * time - phase);
  const Vec air = double(wind.speed) * (1 + gust) * e;

  const Vec g = (Vec(dynamics.gravity) - root_acceleration) / double(chain.length);
  const Vec v = (air - root_velocity) / double(chain.length);
  m.gu = m.l1 * ((m.m1 + m.m2) * g + (m.c1 + m.c2) * v);
  m.gw = m.l2 * (m.m2 * g + m.c2 * v);
  return m;
}

double kinetic(const Model& m, Vec a, Vec b) {
  return (m.inertia_u * glm::dot(a, a) + m.inertia_w * glm::dot(b, b)) / 2 + m.inertia_uw * glm::dot(a, b);
}

double potential(const Model& m, Vec u, Vec w) {
  return m.k1 * (1 - glm::dot(u, m.d)) + m.k2 * (1 - glm::dot(u, w)) - glm::dot(m.gu, u) - glm::dot(m.gw, w);
}

std::array<double, 4> gaps(const Model& m, Vec u, Vec w) {
  return {glm::dot(u, m.d) - std::cos(m.limit1), glm::dot(m.n, u), glm::dot(u, w) - std::cos(m.limit2),
          glm::dot(m.n, m.l1 * u + m.l2 * w)};
}

// Returns the derivatives J of the four gaps with respect to u and w, one gap in each column.
FourPairs gap_derivatives(const Model& m, Vec u, Vec w) {
  FourPairs j;
  j << pair(m.d, Vec(0)), pair(m.n, Vec(0)), pair(w, u), pair(m.l1 * m.n, m.l2 * m.n);
  return j;
}

// The gaps of all stops at the start of a step, and their derivatives J with respect to u and w, one gap in
// each column. Without a body, the gaps of stops 4 and 5 are 1 and their derivatives are 0, so they never
// act.
struct Stops {
  std::array<double, 6> gap;
  Pairs J;
};

// Section "Body": the value of the field at a point of the object's frame, and its derivatives with respect
// to the position. Each of the eight nodes around the point has the weight product(1 - |distance along an
// axis in cells|).
std::pair<double, Vec> field_at(const DistanceField& field, Vec point) {
  Vec at = (point - Vec(field.origin)) / double(field.cell);
  std::array<int, 3> low{};
  for (int axis = 0; axis < 3; ++axis) {
    at[axis] = std::clamp(at[axis], 0.0, double(field.nodes[axis] - 1));
    low[std::size_t(axis)] = std::min(int(std::floor(at[axis])), field.nodes[axis] - 2);
  }
  double value = 0;
  Vec slope(0);
  for (int corner = 0; corner < 8; ++corner) {
    Vec weight, change;
    std::array<int, 3> node{};
    for (int axis = 0; axis < 3; ++axis) {
      const int high = corner >> axis & 1;
      node[std::size_t(axis)] = low[std::size_t(axis)] + high;
      weight[axis] = 1 - std::abs(at[axis] - node[std::size_t(axis)]);
      change[axis] = (high ? 1 : -1) / double(field.cell);
    }
    const auto across = std::size_t(field.nodes.x), down = std::size_t(field.nodes.y);
    const double there = double(
        field.distance[(std::size_t(node[2]) * down + std::size_t(node[1])) * across + std::size_t(node[0])]);
    value += there * weight.x * weight.y * weight.z;
    slope += there * Vec(change.x * weight.y * weight.z, weight.x * change.y * weight.z,
                         weight.x * weight.y * change.z);
  }
  return {value, slope};
}

Stops stops_at(const Model& m, const Chain& chain, const ChainDynamics& dynamics, double time, Vec u, Vec w) {
  Stops s;
  const std::array<double, 4> gap = gaps(m, u, w);
  std::copy(gap.begin(), gap.end(), s.gap.begin());
  s.gap[4] = s.gap[5] = 1;
  s.J.setZero();
  s.J.leftCols<4>() = gap_derivatives(m, u, w);
  if (!dynamics.body) return s;
  constexpr double T = 1.0 / 30;
  const springs::Pose pose = springs::pose_at(dynamics.motion, time);
  const double L = double(chain.length);
  for (std::size_t k = 0; k < 2; ++k) {
    const double l2 = k == 0 ? 0 : m.l2;
    const auto from_root = [&](Vec first, Vec second) { return L * (m.l1 * first + l2 * second); };
    const auto [value, slope] =
        field_at(*dynamics.body, Vec(chain.root) + turned(from_root(u, w), pose.axis, -pose.angle));
    const double at_rest =
        field_at(*dynamics.body, Vec(chain.root) + from_root(chain.rest, chain.rest)).first;
    s.gap[4 + k] = (value - std::min(0.0, at_rest)) / L;
    if (s.gap[4 + k] < 0) s.gap[4 + k] *= std::min(1.0, double(dynamics.step) / T);
    const Vec outwards = turned(slope, pose.axis, pose.angle);
    s.J.col(int(4 + k)) = pair(m.l1 * outwards, l2 * outwards);
  }
  return s;
}

// Returns two unit vectors that are orthogonal to `v` and to each other.
std::array<Vec, 2> tangents(Vec v) {
  const Vec other = std::abs(v.x) < 0.6 * glm::length(v) ? Vec(1, 0, 0) : Vec(0, 1, 0);
  const Vec one = glm::normalize(glm::cross(v, other));
  return {one, glm::normalize(glm::cross(v, one))};
}

// The linear equations for the rates without stops (item 2).
struct Equations {
  double a, b, c;  // A', B', C'
  Pair right;      // right-hand sides, before the multiplication by P_u and P_w
};

Equations equations(const Model& m, const State& s, double eta) {
  const double D1 = (m.c1 + m.c2) * m.l1 * m.l1 + m.d1, D2 = m.c2 * m.l2 * m.l2 + m.d2;
  const double A = m.inertia_u, B = m.inertia_w, C = m.inertia_uw;
  const Vec fu = m.gu + m.k1 * m.d + (m.k2 + C * glm::dot(s.b, s.b)) * s.w;
  const Vec fw = m.gw + (m.k2 + C * glm::dot(s.a, s.a)) * s.u;
  Equations e;
  e.a = A + eta * (D1 + m.d2) + eta * eta * (std::max(glm::dot(m.k1 * m.d + m.gu, s.u), 0.0) + m.k2);
  e.b = B + eta * D2 + eta * eta * (std::max(glm::dot(m.gw, s.w), 0.0) + m.k2);
  e.c = C + eta * (m.c2 * m.l1 * m.l2 - m.d2) - eta * eta * m.k2;
  e.right = pair(A * s.a + C * s.b + eta * fu, C * s.a + B * s.b + eta * fw);
  return e;
}

// Returns the matrix that maps right-hand sides to the rates that solve the equations. The rates are linear
// combinations of vectors orthogonal to u or w (tangents). The equations are projected onto the same
// tangents, which gives 4 equations with 4 unknowns.
PairMatrix solution(const Equations& e, Vec u, Vec w) {
  const auto [u1, u2] = tangents(u);
  const auto [w1, w2] = tangents(w);
  FourPairs basis;
  basis << pair(u1, Vec(0)), pair(u2, Vec(0)), pair(Vec(0), w1), pair(Vec(0), w2);
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  PairMatrix full;
  full << e.a * one, e.c * one, e.c * one, e.b * one;
  const FourPairsT basis_t = basis.transpose();
  const Eigen::Matrix4d tangential = basis_t * full * basis;
  const FourPairsT solved = tangential.partialPivLu().solve(basis_t);
  return basis * solved;
}

// Returns the impulses of the stops (item 3). `lambda` holds the impulses of the previous step. Without
// impulses, the value of gap_i / h + J_i . V is gap[i] / h + speed[i]. The sweeps begin with stop `last`.
std::array<double, 6> impulses(std::array<double, 6> lambda, std::size_t last,
                               const std::array<double, 6>& gap, double h,
                               const Eigen::Matrix<double, 6, 1>& speed, const PairMatrix& W,
                               double softening) {
  for (int sweep = 0; sweep < 4; ++sweep)
    for (std::size_t i = last + 1; i-- > 0;) {
      double others = gap[i] / h + speed[int(i)];
      for (std::size_t j = 0; j <= last; ++j)
        if (j != i) others += W(int(i), int(j)) * lambda[j];
      lambda[i] = std::max(0.0, -others / (W(int(i), int(i)) + softening));
    }
  return lambda;
}

double angle_between(Vec p, Vec q) {
  return std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q));
}

// Returns the axis of the smallest rotation from `p` towards `q`. Any axis orthogonal to `p` is valid if the
// two vectors are parallel.
Vec axis_between(Vec p, Vec q) {
  const Vec normal = glm::cross(p, q);
  const double size = glm::length(normal);
  return size > 0 ? normal / size : tangents(p)[0];
}

// Returns the direction nearest to `v` whose angle to `axis` is at most `limit`.
Vec in_cone(Vec v, Vec axis, double limit) {
  return angle_between(axis, v) > limit ? turned(axis, axis_between(axis, v), limit) : v;
}

// Returns `v` if height(v) is not negative. Otherwise returns the direction on the arc from `v` to `end` at
// which `height` becomes 0. height(end) must not be negative.
template <class Height>
Vec along_arc(Vec v, Vec end, const Height& height) {
  if (height(v) >= 0) return v;
  const Vec axis = axis_between(v, end);
  double below = 0, above = angle_between(v, end);
  for (int i = 0; i < 100; ++i) {  // the interval becomes smaller than the spacing of doubles
    const double middle = (below + above) / 2;
    (height(turned(v, axis, middle)) < 0 ? below : above) = middle;
  }
  return turned(v, axis, above);
}

Vec orthogonal(Vec v, Vec direction) {
  return v - glm::dot(v, direction) * direction;
}

// Returns whether a stop has an impulse above 0.
bool acts(const State& state) {
  const auto above = [](double s) { return s > 0; };
  return std::ranges::any_of(state.stop, above) || std::ranges::any_of(state.body, above);
}

}  // namespace

State in_double(const ChainState& s) {
  // The lengths of single-precision directions differ from 1 by 6e-8. The potential energy would differ by k1
  // 6e-8, and item 6 would stop strands that move slowly.
  State state{glm::normalize(glm::dvec3(s.direction[0])),
              glm::normalize(glm::dvec3(s.direction[1])),
              glm::dvec3(s.rate[0]),
              glm::dvec3(s.rate[1]),
              {},
              {}};
  for (std::size_t i = 0; i < state.stop.size(); ++i) state.stop[i] = double(s.stop[i]);
  for (std::size_t i = 0; i < state.body.size(); ++i) state.body[i] = double(s.body[i]);
  return state;
}

State at_rest(const Chain& chain) {
  State state;
  state.u = state.w = glm::normalize(Vec(chain.rest));  // the angle of the pose at time 0 is 0
  return state;
}

State pushed(const Chain& chain, const ChainDynamics& dynamics, const State& state,
             const pelage::reference::Colliders& colliders) {
  State next = state;
  const double L = double(chain.length), l1 = L * double(dynamics.first_segment);
  const auto push = [&](Vec start, Vec start_velocity, double length, Vec& way, Vec& rate) {
    const pelage::reference::Pushed before{start + length * way, start_velocity + length * rate};
    const pelage::reference::Pushed after = colliders.push(before, Vec(chain.root), Vec(chain.normal));
    if (after.place == before.place && after.velocity == before.velocity) return;
    const Vec segment = after.place - start;
    if (glm::length(segment) > 1e-12) way = glm::normalize(segment);
    rate = orthogonal((after.velocity - start_velocity) / length, way);
  };
  push(Vec(0), Vec(0), l1, next.u, next.a);
  push(l1 * next.u, l1 * next.a, L - l1, next.w, next.b);
  return next;
}

double energy(const Chain& chain, const ChainDynamics& dynamics, const State& state, double time) {
  const Model m = model_at(chain, dynamics, time);
  return kinetic(m, state.a, state.b) + potential(m, state.u, state.w);
}

State step(const Chain& chain, const ChainDynamics& dynamics, const State& state, long number,
           const SkinPoint* skin) {
  const double h = double(dynamics.step);
  const double time = double(number + 1) * h;
  const Model m = model_at(chain, dynamics, time, skin);
  const std::array<double, 4> gap = gaps(m, state.u, state.w);

  // Item 1
  const bool held = acts(state);
  const double x = h * h * (m.k1 + m.k2);
  const double theta = held ? 1 : (m.inertia_u / 2 + x) / (m.inertia_u + x);

  // Item 2
  const Equations e = equations(m, state, theta * h);
  const PairMatrix solve = solution(e, state.u, state.w);
  Pair rates = solve * e.right;

  // Item 3
  State next;
  const Stops stops = stops_at(m, chain, dynamics, time, state.u, state.w);
  const Pair speed = stops.J.transpose() * rates;
  bool needs_impulses = held;
  for (int i = 0; i < 6; ++i) needs_impulses |= stops.gap[std::size_t(i)] + h * speed[i] < 0;
  if (needs_impulses) {
    const PairMatrix W = stops.J.transpose() * solve * stops.J;
    const double alpha = e.a - e.c * e.c / e.b;
    const std::array<double, 6> before{state.stop[0], state.stop[1], state.stop[2],
                                       state.stop[3], state.body[0], state.body[1]};
    const std::array<double, 6> found =
        impulses(before, dynamics.body ? 5 : 3, stops.gap, h, speed, W, 1e-6 * (1 / e.b + 1 / alpha));
    for (std::size_t i = 0; i < 6; ++i) {
      (i < 4 ? next.stop[i] : next.body[i - 4]) = found[i];
      rates += solve * (found[i] * stops.J.col(int(i)));
    }
  }

  // Item 4. With y = h Va / 2, the document's formula for the new direction is a rotation by 2 atan |y|.
  Pair carried = rates;
  if (!held && !acts(next)) carried += (1 / theta - 1) * (rates - pair(state.a, state.b));
  const auto rotated = [&](Vec v, Vec direction, Vec rate) {
    return turned(v, axis_between(direction, rate), 2 * std::atan(h * glm::length(rate) / 2));
  };
  next.u = glm::normalize(rotated(state.u, state.u, first(rates)));
  next.w = glm::normalize(rotated(state.w, state.w, second(rates)));
  next.a = rotated(first(carried), state.u, first(rates));
  next.b = rotated(second(carried), state.w, second(rates));

  // Item 5. Each of the four statements belongs to one stop, and changes nothing if the gap of this stop is
  // not negative.
  next.u = in_cone(next.u, m.d, m.limit1);
  next.u = along_arc(next.u, m.d, [&](Vec v) { return glm::dot(m.n, v); });
  next.w = in_cone(next.w, next.u, m.limit2);
  const auto height = [&](Vec v) { return glm::dot(m.n, m.l1 * next.u + m.l2 * v); };
  if (const Vec flat = orthogonal(next.w, m.n); height(next.w) < 0) {
    // The angle between the raised segment and the plane is asin(height of the joint / l2), below the plane.
    const double angle = std::asin(std::min(1.0, m.l1 * std::max(0.0, glm::dot(m.n, next.u)) / m.l2));
    const bool upright = glm::length(flat) <= 1e-6;
    const Vec raised = upright ? next.w : std::cos(angle) * glm::normalize(flat) - std::sin(angle) * m.n;
    const bool fits = !upright && angle_between(next.u, raised) <= m.limit2;
    next.w = fits ? raised : along_arc(next.w, next.u, height);
  }

  // Item 6
  const double change = potential(m, next.u, next.w) - potential(m, state.u, state.w);
  const double limit = kinetic(m, state.a, state.b) - change;  // E
  if (limit < 0 && *std::ranges::min_element(gap) >= -1e-6) {
    next.u = state.u;
    next.w = state.w;
  }
  next.a = orthogonal(next.a, next.u);
  next.b = orthogonal(next.b, next.w);
  const double found = kinetic(m, next.a, next.b);
  if (found > 0 && found > limit) {
    const double factor = std::sqrt(std::max(limit, 0.0) / found);
    next.a *= factor;
    next.b *= factor;
  }
  return next;
}

}  // namespace pelage::strands::reference
