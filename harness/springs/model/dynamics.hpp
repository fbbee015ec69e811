// What moves the masses: constants, wind, the object's own motion, and the scheme that integrates it.
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "harness/scene/spring_kinds.hpp"
#include "kernels/springs/params.h"

namespace pelage::springs {

/// Air that moves along `direction` with `speed` (1 + gust sin(2 pi (f t - x . direction / wavelength))), x
/// being the stick's root at time 0.
struct Wind {
  glm::vec3 direction{1, 0, 0};  ///< any length but 0
  float speed = 0;               ///< m/s, 1 R being 1 m
  float gust = 0;                ///< fraction of the speed, 0: steady
  float frequency = 1;           ///< Hz
  float wavelength = 1;          ///< R
};

/// The object's motion: x = T(t) + turn by theta(t) about `axis` through the origin, with
/// T = velocity t + shake (1 - cos(2 pi f_shake t)), theta = spin t + swing sin(2 pi f_swing t).
struct Motion {
  glm::vec3 velocity{0};      ///< R/s
  glm::vec3 shake{0};         ///< R
  float shake_frequency = 0;  ///< Hz
  glm::vec3 axis{0, 1, 0};    ///< any length but 0
  float spin = 0;             ///< rad/s
  float swing = 0;            ///< rad
  float swing_frequency = 0;  ///< Hz
};

/// Defaults are plausible fur 0.05 R long with 1 R = 1 m: upright fur leans 18 degrees in a wind of 3 m/s.
struct Dynamics {
  Solver solver = default_solver;
  float step = 1.0f / 240;      ///< dt, s
  float mass = 1e-3f;           ///< of a top, kg; masses on the skin are fixed
  float stiffness = 10;         ///< of the sticks, N/m
  float damping = 0.02f;        ///< of the sticks, N s/m
  float edge_stiffness = 2;     ///< of the springs between tops, N/m
  float edge_damping = 0.004f;  ///< of those, N s/m
  float drag = 0.004f;          ///< against the air, N s/m
  float return_weight = 0.2f;   ///< w of Eq. 5, N
  float residual = 1e-5f;       ///< |r| / |b| at which conjugate gradients stop
  int most_iterations = 500;    ///< of them, per step
  glm::vec3 gravity{0, -9.81f, 0};
  Wind wind;
  Motion motion;
};

/// Throws InputError with one line that names the value and what would be right: dt or m not above 0, a
/// negative constant, anything that is not finite, a direction without a length.
void check(const Dynamics& dynamics);

/// Whether the object turns: its frame is not an inertial one then.
bool turns(const Dynamics& dynamics);

/// The outside world at the times (first + i / 2) dt, i = 0 .. 2 substeps; computed in double, rounded once.
std::vector<Moment> moments(const Dynamics& dynamics, long first, int substeps);

/// A stick longer than this many rest lengths has diverged.
inline constexpr float most_stretch = 100;

/// The kernels' record, but for what a launch and a layout decide (substeps to blocks_per_item).
TopologyParams params(const Dynamics& dynamics, float length);

}  // namespace pelage::springs
