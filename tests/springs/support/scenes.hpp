// Dynamics for the tests.
#pragma once
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs::test {

inline constexpr float fur_length = 0.05f;

/// Everything at once: gravity, gusts, an object that travels, shakes and swings.
inline Dynamics lively(Solver solver) {
  Dynamics d;
  d.solver = solver;
  d.step = solver == Solver::explicit_euler ? 1e-3f : 1.0f / 240;
  d.wind = {{1, 0.2f, 0.5f}, 3, 0.4f, 1, 0.7f};
  d.motion = {{0.3f, 0, 0.1f}, {0.02f, 0.05f, -0.01f}, 1.3f, {0.3f, 1, 0.2f}, 0.7f, 0.4f, 1.1f};
  return d;
}

/// No gravity, no wind, no drag, an object at rest: nothing but springs and Eq. 5.
inline Dynamics still(Solver solver) {
  Dynamics d;
  d.solver = solver;
  d.gravity = {0, 0, 0};
  d.drag = 0;
  return d;
}

}  // namespace pelage::springs::test
