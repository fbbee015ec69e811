// Code that the studies of the mass-spring solvers share.
#pragma once
#include <functional>
#include <utility>

#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/springs/reference/reference.hpp"
#include "harness/springs/studies/study.hpp"

namespace pelage::springs {

/// Returns the state at rest: every stick points along its normal, and all velocities are 0.
Motions rest_motions(const SpringNetwork& topology);

/// Returns the state of the reference with these positions and velocities of the top masses.
reference::State reference_state(const SpringNetwork& topology, const Motions& motions);

/// Simulates `seconds` of motion in launches of about `look` seconds each, with at least one time step per
/// launch. After each launch, calls `after` with the simulated time in seconds; the simulation ends if
/// `after` returns false.
void simulate(const cl::Queue& queue, MassSprings& masses, const Dynamics& dynamics, double seconds,
              double look = 1.0 / 60, const std::function<bool(double)>& after = {});

/// Throws OutOfBounds if a mass has diverged.
void bounded(const cl::Queue& queue, const MassSprings& masses);

/// Base class of the studies. Each call of frame() makes one whole measurement.
class Study : public Subject {
 public:
  Study(const cl::Device& device, Setting setting) : queue_(device), setting_(std::move(setting)) {}
  Picture read() override { return {}; }
  void describe(Row& row) override;

 protected:
  /// Simulates one second and returns the wall time in ms.
  double second(MassSprings& masses) const;

  cl::Queue queue_;
  Setting setting_;
  Identity programs_;  // identity parts of the programs that ran; the studies add them with add_programs()
};

}  // namespace pelage::springs
