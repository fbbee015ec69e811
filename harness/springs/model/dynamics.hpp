// Parameters of a mass-spring simulation: physical constants, wind, motion of the object that carries the
// fur, and integration scheme.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "harness/scene/spring_kinds.hpp"
#include "harness/springs/model/motion.hpp"
#include "kernels/springs/params.h"

namespace pelage::springs {

/// A stick has diverged if it is longer than this many rest lengths.
inline constexpr float most_stretch = 100;

/// Constants of the simulation. The defaults describe plausible fur of length 0.05 R. The length unit R, the
/// radius of the mesh's bounding sphere, counts as 1 m. In equilibrium, upright fur with these defaults leans
/// 18.0 degrees under its weight, and 31.5 degrees in a steady horizontal wind of 3 m/s.
struct Dynamics {
  Solver solver = default_solver;
  float step = 1.0f / 240;      ///< dt, s
  float mass = 1e-3f;           ///< mass at the top of a stick in kg; the base of a stick is fixed
  float stiffness = 10;         ///< stiffness of the sticks in N/m
  float damping = 0.02f;        ///< damping of the sticks in N s/m
  float edge_stiffness = 2;     ///< stiffness of the springs between top masses in N/m
  float edge_damping = 0.004f;  ///< damping of the springs between top masses in N s/m
  float drag = 0.004f;          ///< drag coefficient of a top mass in air, in N s/m
  float return_weight = 0.2f;   ///< weight w of the return force in N (Eq. 5 of Banisch and Wuethrich 2006)
  float residual = 1e-5f;       ///< relative residual |r| / |b| of A x = b at which conjugate gradients stop
  int most_iterations = 500;    ///< largest number of conjugate gradient iterations per step
  /// False: backward Euler omits the terms of the derivatives that would make its matrix asymmetric or
  /// indefinite (docs/springs.md, section Solvers).
  bool full_jacobian = false;
  float lost_stretch = most_stretch;  ///< a longer stick, in rest lengths, has diverged; above 1
  glm::vec3 gravity{0, -9.81f, 0};
  Wind wind;
  Motion motion;
};

/// Throws InputError if a value is not finite or outside its valid range, or if a direction is the zero
/// vector. The message is one line that names the value and the valid range.
void check(const Dynamics& dynamics);

/// Returns wind, gravity and the object's motion at the times (first + i / 2) * dt for i = 0 to 2 * substeps,
/// where `first` is the index of the first step and dt is the time step. All values are computed in double
/// precision and then rounded to float.
std::vector<Moment> moments(const Dynamics& dynamics, long first, int substeps);

/// Returns the kernels' parameters. `length` is the length of the sticks in R. Members that depend on the
/// launch or the layout, such as `substeps` and `blocks`, are 0.
TopologyParams params(const Dynamics& dynamics, float length);

}  // namespace pelage::springs
