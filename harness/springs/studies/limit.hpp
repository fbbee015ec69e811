// Finds the longest time step with which a mass-spring simulation stays bounded.
#pragma once
#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {

/// A stick that reaches this many rest lengths after any step makes the time step too long.
inline constexpr float most_stick = 2;
/// The simulated time in seconds, from rest, in which no stick may become that long.
inline constexpr double limit_seconds = 2;

struct Limit {
  /// Longest step in seconds, to 2%; at most 1 s; 0 if even a step of about 15 us is too long.
  double step = 0;
  double longest = 0;  ///< length of the longest stick after any step of this length, in rest lengths
  int tried = 0;       ///< number of time steps that were tried
};

/// Finds the longest time step by bisection. After every step, the kernels compare the length of every stick
/// with `most_stick`. The host asks for the result about every `look` seconds of simulated time. This
/// interval only decides how soon the simulation of an unstable step ends; the result does not depend on it.
Limit longest_step(const cl::Queue& queue, const SpringNetwork& topology, const Dynamics& dynamics,
                   double look = 1.0 / 60);

}  // namespace pelage::springs
