// Parameters of the motion of the masses: constants, wind, the object's own motion, and the integration
// scheme.
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "harness/scene/spring_kinds.hpp"
#include "kernels/springs/params.h"

namespace pelage::springs {

/// Air that moves along `direction` with the speed `speed` (1 + gust sin(2 pi (f t - x . direction /
/// wavelength))), where x is the root of the stick at time 0.
struct Wind {
  glm::vec3 direction{1, 0, 0};  ///< not normalized; must not be 0
  float speed = 0;               ///< m/s, where 1 R counts as 1 m
  float gust = 0;                ///< amplitude as a fraction of `speed`; 0 for steady wind
  float frequency = 1;           ///< Hz
  float wavelength = 1;          ///< R
};

/// The object's motion: a rotation by theta(t) about `axis` through the origin, followed by the translation
/// T(t). T = velocity t + shake (1 - cos(2 pi f_shake t)), theta = spin t + swing sin(2 pi f_swing t).
struct Motion {
  glm::vec3 velocity{0};      ///< R/s
  glm::vec3 shake{0};         ///< R
  float shake_frequency = 0;  ///< Hz
  glm::vec3 axis{0, 1, 0};    ///< not normalized; must not be 0
  float spin = 0;             ///< rad/s
  float swing = 0;            ///< rad
  float swing_frequency = 0;  ///< Hz
};

/// Constants of the simulation. The defaults describe plausible fur of length 0.05 R, where 1 R counts as 1
/// m: upright fur leans 18 degrees in a wind of 3 m/s.
struct Dynamics {
  Solver solver = default_solver;
  float step = 1.0f / 240;      ///< dt, s
  float mass = 1e-3f;           ///< mass at the top of a stick, kg; masses on the skin are fixed
  float stiffness = 10;         ///< stiffness of the sticks, N/m
  float damping = 0.02f;        ///< damping of the sticks, N s/m
  float edge_stiffness = 2;     ///< stiffness of the springs between top masses, N/m
  float edge_damping = 0.004f;  ///< damping of the springs between top masses, N s/m
  float drag = 0.004f;          ///< drag coefficient of a top mass in air, N s/m
  float return_weight = 0.2f;   ///< w of Eq. 5, N
  float residual = 1e-5f;       ///< conjugate gradients stop when |r| / |b| is at most this
  int most_iterations = 500;    ///< limit of conjugate gradient iterations per step
  glm::vec3 gravity{0, -9.81f, 0};
  Wind wind;
  Motion motion;
};

/// Checks all values. Throws InputError with one line that names the value and its valid range if dt or m is
/// not above 0, a constant is negative, a value is not finite, or a direction is the zero vector.
void check(const Dynamics& dynamics);

/// Returns whether the object rotates. If so, its frame is not an inertial frame.
bool turns(const Dynamics& dynamics);

/// Returns the environment (gravity, wind, the object's motion) at the times (first + i / 2) dt, i = 0 .. 2
/// substeps. All values are computed in double precision and then rounded to float.
std::vector<Moment> moments(const Dynamics& dynamics, long first, int substeps);

/// A stick has diverged if it is longer than this many rest lengths.
inline constexpr float most_stretch = 100;

/// Returns the kernels' parameters for sticks of `length` R. The members that depend on the launch or the
/// layout (substeps to blocks_per_item) are 0.
TopologyParams params(const Dynamics& dynamics, float length);

}  // namespace pelage::springs
