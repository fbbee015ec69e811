// Finds the longest time step with which a mass-spring simulation stays bounded.
#pragma once
#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {

/// A time step is too long if a stick reaches this many rest lengths after any step.
inline constexpr float most_stick = 2;
/// Duration, in seconds, of the simulation that tests a time step. The simulation starts at rest. In a stable
/// simulation, no stick reaches `most_stick` rest lengths.
inline constexpr double limit_seconds = 2;

struct Limit {
  /// Longest stable time step in seconds, with a relative error of at most 2%. Steps above 1 s are not tried.
  /// The value is 0 if even a step of about 15 us is too long.
  double step = 0;
  double longest = 0;  ///< greatest length of a stick in the simulation with `step`, in rest lengths
  int tried = 0;       ///< number of time steps that were tried
};

/// Finds the longest stable time step by bisection. After every step, the kernels compare the length of every
/// stick with `most_stick`. The host reads the outcome about every `look` seconds of simulated time, which
/// only determines how soon an unstable simulation ends.
Limit longest_step(const cl::Queue& queue, const SpringNetwork& topology, const Dynamics& dynamics,
                   double look = 1.0 / 60);

}  // namespace pelage::springs
