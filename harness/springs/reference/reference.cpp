#include "harness/springs/reference/reference.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <stdexcept>

namespace pelage::springs::reference {
namespace {

using Vectors = std::vector<glm::dvec3>;

// The object's motion X = T + R r, which moves the object's point r to X. `shift` is the translation T, and
// `turn` is the rotation R. The suffixes _1 and _2 mark the first and the second time derivatives of T and R.
struct Pose {
  glm::dvec3 shift, shift_1, shift_2;
  glm::dmat3 turn, turn_1, turn_2;
};

Pose pose(const Motion& m, double t) {
  const double tau = 2 * std::numbers::pi;
  const double a = tau * double(m.shake_frequency), b = tau * double(m.swing_frequency);
  const glm::dvec3 shake(m.shake), velocity(m.velocity), n = glm::normalize(glm::dvec3(m.axis));
  const double angle = double(m.spin) * t + double(m.swing) * std::sin(b * t);
  const double angle_1 = double(m.spin) + double(m.swing) * b * std::cos(b * t);
  const double angle_2 = -double(m.swing) * b * b * std::sin(b * t);
  // Rodrigues' formula for the axis n: R = c I + s [n] + (1 - c) n n^T, where c and s are the cosine and the
  // sine of `angle`, and [n] is the cross-product matrix of n. The chain rule gives the derivatives of R with
  // respect to time from the derivatives of R with respect to the angle.
  const glm::dmat3 identity(1), outer = glm::outerProduct(n, n);
  const glm::dmat3 cross(glm::dvec3(0, n.z, -n.y), glm::dvec3(-n.z, 0, n.x), glm::dvec3(n.y, -n.x, 0));
  const double c = std::cos(angle), s = std::sin(angle);
  const glm::dmat3 by_angle = -s * identity + c * cross + s * outer,
                   by_angle_2 = -c * identity - s * cross + c * outer;
  return {velocity * t + shake * (1 - std::cos(a * t)),
          velocity + shake * a * std::sin(a * t),
          shake * a * a * std::cos(a * t),
          c * identity + s * cross + (1 - c) * outer,
          by_angle * angle_1,
          by_angle_2 * (angle_1 * angle_1) + by_angle * angle_2};
}

struct Spring {
  glm::dvec3 along;  // unit vector from the first to the second mass; 0 if the masses coincide
  double length, rest, stiffness, damping;
};

Spring spring(const System& system, const State& state, std::size_t number) {
  const Dynamics& d = system.dynamics;
  const glm::uvec2 ends = system.network.spring[number];
  const glm::dvec3 between = state.position[ends.y] - state.position[ends.x];
  const double length = glm::length(between);
  const bool stick = number < system.network.sticks();
  return {length > 0 ? between / length : glm::dvec3(0), length, double(system.network.rest[number]),
          double(stick ? d.stiffness : d.edge_stiffness), double(stick ? d.damping : d.edge_damping)};
}

// Returns the sum of weight, wind, drag and inertial forces on a mass at `r` with the velocity `v`, in
// newtons, in the object's frame. `gust_at` is the position at which the gusts are computed.
glm::dvec3 outside(const Dynamics& d, const Pose& at, double time, glm::dvec3 gust_at, glm::dvec3 r,
                   glm::dvec3 v) {
  const double m = double(d.mass), tau = 2 * std::numbers::pi;
  const glm::dvec3 blow = glm::normalize(glm::dvec3(d.wind.direction));
  const double swell =
      std::sin(tau * (double(d.wind.frequency) * time - glm::dot(gust_at, blow) / double(d.wind.wavelength)));
  const glm::dvec3 air = double(d.wind.speed) * (1 + double(d.wind.gust) * swell) * blow;
  const glm::dvec3 velocity = at.shift_1 + at.turn_1 * r + at.turn * v;
  const glm::dvec3 carried = at.shift_2 + at.turn_2 * r + 2.0 * (at.turn_1 * v);
  const glm::dvec3 world = m * glm::dvec3(d.gravity) + double(d.drag) * (air - velocity) - m * carried;
  return glm::transpose(at.turn) * world;
}

State moved(const State& from, double h, const Vectors& position_rate, const Vectors& velocity_rate) {
  State to = from;
  for (std::size_t i = 0; i < to.position.size(); ++i) {
    to.position[i] += h * position_rate[i];
    to.velocity[i] += h * velocity_rate[i];
  }
  return to;
}

// Returns the acceleration of every mass. The masses on the skin are fixed.
Vectors accelerations(const System& system, const State& state, double time) {
  Vectors a = forces(system, state, time);
  for (std::size_t i = 0; i < a.size(); ++i)
    a[i] = i < system.network.sticks() ? glm::dvec3(0) : a[i] / double(system.dynamics.mass);
  return a;
}

State explicit_euler(const System& system, const State& y, double t, double h) {
  return moved(y, h, y.velocity, accelerations(system, y, t));
}

State semi_implicit_euler(const System& system, const State& y, double t, double h) {
  State next = moved(y, h, Vectors(y.position.size(), glm::dvec3(0)), accelerations(system, y, t));
  for (std::size_t i = 0; i < next.position.size(); ++i) next.position[i] += h * next.velocity[i];
  return next;
}

State rk4(const System& system, const State& y, double t, double h) {
  const Vectors a1 = accelerations(system, y, t);
  const State y2 = moved(y, h / 2, y.velocity, a1);
  const Vectors a2 = accelerations(system, y2, t + h / 2);
  const State y3 = moved(y, h / 2, y2.velocity, a2);
  const Vectors a3 = accelerations(system, y3, t + h / 2);
  const State y4 = moved(y, h, y3.velocity, a3);
  const Vectors a4 = accelerations(system, y4, t + h);
  State next = y;
  for (std::size_t i = 0; i < y.position.size(); ++i) {
    next.position[i] +=
        h / 6 * (y.velocity[i] + 2.0 * y2.velocity[i] + 2.0 * y3.velocity[i] + y4.velocity[i]);
    next.velocity[i] += h / 6 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]);
  }
  return next;
}

State predictor_corrector(const System& system, const State& y, double t, double h) {
  const Vectors before = accelerations(system, y, t);
  State next = moved(y, h, y.velocity, before);
  for (int correction = 0; correction < 2; ++correction) {
    const Vectors after = accelerations(system, next, t + h);
    State corrected = y;
    for (std::size_t i = 0; i < y.position.size(); ++i) {
      corrected.position[i] += h / 2 * (y.velocity[i] + next.velocity[i]);
      corrected.velocity[i] += h / 2 * (before[i] + after[i]);
    }
    next = std::move(corrected);
  }
  return next;
}

glm::dmat3 across(glm::dvec3 unit) {
  return glm::dmat3(1) - glm::outerProduct(unit, unit);
}

// Derivatives of the force on the top of stick `row` with respect to the position (j) and the velocity (d) of
// the top of stick `column`. The matrices of blocks with the same row and column are added.
struct Block {
  std::size_t row, column;
  glm::dmat3 j, d;
};

// Returns the matrix a b^T.
glm::dmat3 outer(glm::dvec3 a, glm::dvec3 b) {
  return glm::outerProduct(a, b);
}

// The derivatives of the force that a spring exerts on the mass at its first end, with respect to the
// position (j) and the velocity (d) of the mass at the second end. If `full` is false, j contains neither the
// transverse stiffness of a compressed spring nor the derivative of the damping force.
struct Pull {
  glm::dmat3 j, d;
};
Pull pull_of(const Spring& s, glm::dvec3 parting, bool full) {
  if (!(s.length > 0)) return {glm::dmat3(0), glm::dmat3(0)};
  const double slack = 1 - s.rest / s.length;
  Pull pull{s.stiffness * (outer(s.along, s.along) + (full ? slack : std::max(0.0, slack)) * across(s.along)),
            s.damping * outer(s.along, s.along)};
  if (full)
    pull.j += s.damping / s.length *
              (outer(s.along, across(s.along) * parting) + glm::dot(parting, s.along) * across(s.along));
  return pull;
}

// Returns the derivative of a stick's return force (Eq. 5 of Banisch and Wuethrich 2006) with respect to the
// position of the stick's top mass. If `full` is false, omits the term that is not symmetric.
glm::dmat3 return_derivative(const Spring& stick, glm::dvec3 n, double weight, bool full) {
  const double cosine = glm::dot(n, stick.along);
  const glm::dvec3 lean = n - cosine * stick.along;
  glm::dmat3 j = (1 - cosine) * across(stick.along) + outer(lean, lean);
  if (full) j -= (1 - cosine) * outer(stick.along, lean);
  return -weight / stick.length * j;
}

std::vector<Block> derivative_blocks(const System& system, const State& y, double t) {
  const SpringNetwork& network = system.network;
  const Dynamics& dynamics = system.dynamics;
  const std::size_t sticks = network.sticks();
  const bool full = dynamics.full_jacobian;
  const Pose at = pose(dynamics.motion, t);
  const double m = double(dynamics.mass), drag = double(dynamics.drag);
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < sticks; ++i) {
    Block own{i, i,
              return_derivative(spring(system, y, i), glm::dvec3(network.normal[i]),
                                double(dynamics.return_weight), full),
              glm::dmat3(-drag)};
    if (full) {  // derivatives of the inertial forces and the drag on a rotating object
      const glm::dmat3 back = glm::transpose(at.turn);
      own.j -= back * (drag * at.turn_1 + m * at.turn_2);
      own.d -= 2 * m * (back * at.turn_1);
    }
    blocks.push_back(own);
  }
  for (std::size_t k = 0; k < network.spring.size(); ++k) {
    const glm::uvec2 ends = network.spring[k];
    const Pull pull = pull_of(spring(system, y, k), y.velocity[ends.y] - y.velocity[ends.x], full);
    for (const auto& [self, other] : {std::pair(ends.x, ends.y), std::pair(ends.y, ends.x)}) {
      if (self < sticks) continue;  // a fixed mass on the skin
      blocks.push_back({self - sticks, self - sticks, -pull.j, -pull.d});
      if (other >= sticks) blocks.push_back({self - sticks, other - sticks, pull.j, pull.d});
    }
  }
  return blocks;
}

// The linear system of linearised backward Euler: (M - h D - h^2 J) dv = h (f + h J v). M is the matrix of
// the masses, h the time step, v the velocity before the step, and dv its change. f is the force for the
// positions and velocities before the step, with the wind and the object's motion at its end. J and D are the
// derivatives of derivative_blocks().
struct Equations {
  Eigen::SparseMatrix<double> matrix;
  Eigen::VectorXd right;
};

Equations backward_equations(const System& system, const State& y, double t, double h) {
  const SpringNetwork& network = system.network;
  const std::size_t sticks = network.sticks();
  const auto size = Eigen::Index(3 * sticks);
  const Vectors f = forces(system, y, t + h);
  Eigen::VectorXd right(size);
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](std::size_t row, std::size_t column, const glm::dmat3& block) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) entries.emplace_back(int(3 * row) + i, int(3 * column) + j, block[j][i]);
  };
  Vectors load(sticks);
  for (std::size_t i = 0; i < sticks; ++i) {
    add(i, i, glm::dmat3(double(system.dynamics.mass)));
    load[i] = h * f[network.top(i)];
  }
  for (const Block& block : derivative_blocks(system, y, t + h)) {
    add(block.row, block.column, -h * block.d - h * h * block.j);
    load[block.row] += h * h * (block.j * y.velocity[network.top(block.column)]);
  }
  for (std::size_t i = 0; i < sticks; ++i)
    for (int c = 0; c < 3; ++c) right[Eigen::Index(3 * i) + c] = load[i][c];
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return {matrix, right};
}

// Solves the equations by LDL^T factorization if the matrix is symmetric, and otherwise by LU factorization.
Eigen::VectorXd solved(const Equations& equations, bool symmetric) {
  const auto by = [&](auto&& factors) -> Eigen::VectorXd {
    factors.compute(equations.matrix);
    if (factors.info() != Eigen::Success)
      throw std::runtime_error(
          "backward Euler: the factorization of the matrix failed; a shorter time step may help");
    return factors.solve(equations.right);
  };
  return symmetric ? by(Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>())
                   : by(Eigen::SparseLU<Eigen::SparseMatrix<double>>());
}

State backward_euler(const System& system, const State& y, double t, double h) {
  const SpringNetwork& network = system.network;
  const Equations equations = backward_equations(system, y, t, h);
  const Eigen::VectorXd change = solved(equations, !system.dynamics.full_jacobian);
  State next = y;
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    for (int c = 0; c < 3; ++c) next.velocity[network.top(i)][c] += change[Eigen::Index(3 * i) + c];
    next.position[network.top(i)] += h * next.velocity[network.top(i)];
  }
  return next;
}

}  // namespace

State rest(const SpringNetwork& network) {
  State state;
  state.velocity.assign(network.mass.size(), glm::dvec3(0));
  for (std::size_t i = 0; i < network.sticks(); ++i) state.position.push_back(glm::dvec3(network.mass[i]));
  for (std::size_t i = 0; i < network.sticks(); ++i)
    state.position.push_back(state.position[i] + glm::dvec3(network.length * network.normal[i]));
  return state;
}

Vectors forces(const System& system, const State& state, double time) {
  const SpringNetwork& network = system.network;
  const Dynamics& d = system.dynamics;
  const Pose at = pose(d.motion, time);
  Vectors force;
  for (std::size_t i = 0; i < network.mass.size(); ++i)
    force.push_back(outside(d, at, time, glm::dvec3(network.gust_at[i % network.sticks()]), state.position[i],
                            state.velocity[i]));
  for (std::size_t k = 0; k < network.spring.size(); ++k) {  // Hooke's law, and damping along the spring
    const Spring s = spring(system, state, k);
    const glm::uvec2 ends = network.spring[k];
    const double parting = glm::dot(state.velocity[ends.y] - state.velocity[ends.x], s.along);
    const glm::dvec3 pull = (s.stiffness * (s.length - s.rest) + s.damping * parting) * s.along;
    force[ends.x] += pull;
    force[ends.y] -= pull;
  }
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    const glm::dvec3 n(network.normal[i]), s = spring(system, state, i).along;          // Eq. 3
    force[network.top(i)] += (n - s) * (1 - glm::dot(n, s)) * double(d.return_weight);  // Eq. 5
    if (!system.push.empty()) force[network.top(i)] += system.push[i];
  }
  return force;
}

namespace {

State wind_vectors(const System& system, const State& y, double t) {
  const SpringNetwork& network = system.network;
  const Dynamics& d = system.dynamics;
  const Pose at = pose(d.motion, t);
  State next = y;
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    const std::size_t top = network.top(i);
    glm::dvec3 force = outside(d, at, t, glm::dvec3(network.gust_at[i]), y.position[top], glm::dvec3(0));
    if (!system.push.empty()) force += system.push[i];
    next.velocity[top] = 0.5 * (y.velocity[top] + force);
    const glm::dvec3 way = double(d.return_weight) * glm::dvec3(network.normal[i]) + next.velocity[top];
    next.position[top] = y.position[i] + double(network.length) * glm::normalize(way);
  }
  return next;
}

}  // namespace

State step(const System& system, const State& state, long number) {
  const double h = double(system.dynamics.step), t = double(number) * h;
  const Solver& solver = system.dynamics.solver;
  if (!solver.newton) return wind_vectors(system, state, t);
  if (solver.implicit) return backward_euler(system, state, t, h);
  if (solver == Solver::rk4) return rk4(system, state, t, h);
  if (solver == Solver::predictor_corrector) return predictor_corrector(system, state, t, h);
  return solver.in_turn ? semi_implicit_euler(system, state, t, h) : explicit_euler(system, state, t, h);
}

State after(const System& system, State state, long first, long steps) {
  for (long i = 0; i < steps; ++i) state = step(system, state, first + i);
  return state;
}

State on_new_skin(const SpringNetwork& network, State state, const Vectors& change) {
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    const glm::dvec3 base(network.mass[i]);
    state.position[network.top(i)] += base - state.position[i];
    state.position[i] = base;
    state.velocity[network.top(i)] -= change[i];
  }
  return state;
}

double residual(const System& system, const State& state, long number, const Vectors& change) {
  const double h = double(system.dynamics.step);
  const Equations equations = backward_equations(system, state, double(number) * h, h);
  Eigen::VectorXd x(equations.right.size());
  for (std::size_t i = 0; i < change.size(); ++i)
    for (int c = 0; c < 3; ++c) x[Eigen::Index(3 * i) + c] = change[i][c];
  return (equations.right - equations.matrix * x).norm() / equations.right.norm();
}

Derivatives derivatives(const System& system, const State& state, double time) {
  const std::size_t size = 3 * system.network.sticks();
  Derivatives found{size, std::vector<double>(size * size, 0.0), std::vector<double>(size * size, 0.0)};
  for (const Block& block : derivative_blocks(system, state, time))
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t at = (3 * block.row + i) * size + 3 * block.column + j;
        found.by_position[at] += block.j[int(j)][int(i)];
        found.by_velocity[at] += block.d[int(j)][int(i)];
      }
  return found;
}

double energy(const System& system, const State& state) {
  double sum = 0;
  for (std::size_t i = system.network.sticks(); i < state.velocity.size(); ++i)
    sum += 0.5 * double(system.dynamics.mass) * glm::dot(state.velocity[i], state.velocity[i]);
  for (std::size_t k = 0; k < system.network.spring.size(); ++k) {
    const Spring s = spring(system, state, k);
    sum += 0.5 * s.stiffness * (s.length - s.rest) * (s.length - s.rest);
  }
  return sum;
}

double total_energy(const System& system, const State& state) {
  double sum = energy(system, state);
  for (std::size_t i = system.network.sticks(); i < state.position.size(); ++i)
    sum -= double(system.dynamics.mass) * glm::dot(glm::dvec3(system.dynamics.gravity), state.position[i]);
  return sum;
}

Vectors offsets(const SpringNetwork& network, const State& state) {
  Vectors q;
  for (std::size_t i = 0; i < network.sticks(); ++i)
    q.push_back(state.position[network.top(i)] - state.position[i]);
  return q;
}

}  // namespace pelage::springs::reference
