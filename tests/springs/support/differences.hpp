// Computes the derivatives of the reference's forces by finite differences. The reference, the kernels and
// the baselines use formulas of the derivatives. Finite differences do not use these formulas, so they detect
// a mistake even if all three implementations contain it.
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "harness/springs/reference/reference.hpp"

namespace pelage::springs::test {

using Matrix = Eigen::MatrixXd;

/// Returns the derivative of the forces on the top masses with respect to the positions of the top masses. If
/// `by_velocity` is true, returns the derivative with respect to their velocities instead.
inline Matrix differences(const reference::System& system, const reference::State& state, double time,
                          bool by_velocity) {
  const SpringNetwork& network = system.network;
  const auto size = Eigen::Index(3 * network.sticks());
  constexpr double small = 1e-6;  // in R or R/s
  Matrix found(size, size);
  for (std::size_t i = 0; i < network.sticks(); ++i)
    for (int c = 0; c < 3; ++c) {
      reference::State up = state, down = state;
      const std::size_t top = network.top(i);
      (by_velocity ? up.velocity : up.position)[top][c] += small;
      (by_velocity ? down.velocity : down.position)[top][c] -= small;
      const auto more = reference::forces(system, up, time), less = reference::forces(system, down, time);
      for (std::size_t k = 0; k < network.sticks(); ++k)
        for (int r = 0; r < 3; ++r)
          found(Eigen::Index(3 * k) + r, Eigen::Index(3 * i) + c) =
              (more[network.top(k)][r] - less[network.top(k)][r]) / (2 * small);
    }
  return found;
}

/// The linear system A x = b of a backward Euler step, where x is the change of the top masses' velocities.
struct Step {
  Matrix a;
  Eigen::VectorXd b;
};

/// Returns the system (M - h D - h^2 J) x = h (f + h J v). M is the mass matrix and h the time step. J and D
/// are the derivatives of the forces with respect to the positions and to the velocities. f are the forces of
/// `state` at `time`, and v are its velocities.
inline Step assembled(const reference::System& system, const reference::State& state, double time,
                      const Matrix& j, const Matrix& d) {
  const SpringNetwork& network = system.network;
  const double h = double(system.dynamics.step);
  const auto size = Eigen::Index(3 * network.sticks());
  const auto forces = reference::forces(system, state, time);
  Eigen::VectorXd f(size), v(size);
  for (std::size_t i = 0; i < network.sticks(); ++i)
    for (int c = 0; c < 3; ++c) {
      f[Eigen::Index(3 * i) + c] = forces[network.top(i)][c];
      v[Eigen::Index(3 * i) + c] = state.velocity[network.top(i)][c];
    }
  return {double(system.dynamics.mass) * Matrix::Identity(size, size) - h * d - h * h * j,
          h * (f + h * (j * v))};
}

/// Returns the system of time step `number`, computed by finite differences. The derivatives omit the same
/// terms as the solvers do by default (the pruned Jacobian of docs/springs.md). All springs of `state` must
/// be longer than at rest, and the object must not move. Under these conditions, the pruned derivatives are
/// the sum of two parts. The first part is the exact derivative of the spring forces at velocity 0. The
/// second part is the exact derivative of the return force, projected onto the plane perpendicular to the
/// stick.
inline Step step_by_differences(const reference::System& system, const reference::State& state, long number) {
  const SpringNetwork& network = system.network;
  const double time = double(number + 1) * double(system.dynamics.step);
  reference::State still = state;
  for (glm::dvec3& v : still.velocity) v = glm::dvec3(0);
  Dynamics springs = system.dynamics, back = system.dynamics;
  springs.return_weight = 0;
  back.stiffness = back.damping = back.edge_stiffness = back.edge_damping = back.drag = 0;
  Matrix j = differences({network, springs}, still, time, false);
  const Matrix turning = differences({network, back}, still, time, false);
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    const glm::dvec3 s = glm::normalize(state.position[network.top(i)] - state.position[i]);
    const Eigen::Vector3d along(s.x, s.y, s.z);
    const auto at = Eigen::Index(3 * i);
    j.block<3, 3>(at, at) +=
        (Eigen::Matrix3d::Identity() - along * along.transpose()) * turning.block<3, 3>(at, at);
  }
  return assembled(system, state, time, j, differences(system, state, time, true));
}

/// Returns the system of time step `number` with all terms of the derivatives, computed by finite
/// differences.
inline Step full_step_by_differences(const reference::System& system, const reference::State& state,
                                     long number) {
  const double time = double(number + 1) * double(system.dynamics.step);
  return assembled(system, state, time, differences(system, state, time, false),
                   differences(system, state, time, true));
}

/// Returns the relative residual |b - A x| / |b|, where x is the change from the velocities `before` to the
/// velocities `after`.
inline double residual_of(const Step& step, const std::vector<glm::dvec3>& before,
                          const std::vector<glm::dvec3>& after) {
  Eigen::VectorXd x(step.b.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    for (int c = 0; c < 3; ++c) x[Eigen::Index(3 * i) + c] = after[i][c] - before[i][c];
  return (step.b - step.a * x).norm() / step.b.norm();
}

/// Returns a state in which most sticks are bent by 20 to 50 degrees and every spring is longer than at rest.
/// To this end, the function moves the top masses outwards and rotates them by 0.3 rad about an axis. The
/// sticks are bent, because the derivative of the return force is small for upright sticks. Positions and
/// velocities are rounded to floats, so that kernels and baselines can start from exactly this state.
inline reference::State stretched(const SpringNetwork& network) {
  reference::State state = reference::rest(network);
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, 3));
  const auto turned = [&axis](const glm::dvec3& v) {  // rotates v by 0.3 rad with Rodrigues' formula
    const glm::dvec3 across = glm::cross(axis, v);
    return v + std::sin(0.3) * across + (1 - std::cos(0.3)) * glm::cross(axis, across);
  };
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    const double a = double(i);
    const glm::dvec3 q = 1.3 * turned(state.position[network.top(i)]) +
                         0.01 * glm::dvec3(std::sin(a), std::cos(2 * a), std::sin(3 * a)) - state.position[i];
    state.position[network.top(i)] = state.position[i] + glm::dvec3(glm::vec3(q));
    state.velocity[network.top(i)] =
        glm::dvec3(glm::vec3(0.3 * std::cos(a), 0.2 * std::sin(5 * a), 0.1 * std::cos(3 * a)));
  }
  return state;
}

/// Returns a state in which the sticks are bent, some springs are stretched and others are compressed.
/// Positions and velocities are rounded as in stretched().
inline reference::State crumpled(const SpringNetwork& network) {
  reference::State state = reference::rest(network);
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    const double a = double(i);
    state.position[network.top(i)] +=
        glm::dvec3(glm::vec3(0.03 * std::sin(a), 0.03 * std::cos(2 * a), 0.03 * std::sin(3 * a)));
    state.velocity[network.top(i)] = glm::dvec3(glm::vec3(std::cos(a), std::sin(5 * a), 0.3));
  }
  return state;
}

/// Returns the velocities of the top masses.
inline std::vector<glm::dvec3> speeds_of(const SpringNetwork& network, const reference::State& state) {
  return {state.velocity.begin() + std::ptrdiff_t(network.sticks()), state.velocity.end()};
}

/// Returns dynamics with the backward Euler solver and an object at rest. Springs and return force are so
/// strong that every term of the derivatives changes the matrix of the system noticeably.
inline Dynamics stiff_step() {
  Dynamics d;
  d.solver = *std::find_if(solvers.begin(), solvers.end(), [](const Solver& s) { return s.implicit; });
  d.step = 1.0f / 60;
  d.edge_stiffness = 6;
  d.return_weight = 0.8f;
  d.residual = 1e-7f;
  d.wind = {{1, 0.2f, 0.5f}, 3, 0.4f, 1, 0.7f};
  return d;
}

}  // namespace pelage::springs::test
