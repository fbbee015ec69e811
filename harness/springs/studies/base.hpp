// The base class of the studies, and functions that several studies call. A study is a measurement on
// mass-spring solvers that differs from the plain timing of frames.
#pragma once
#include <functional>
#include <utility>

#include "harness/measure/cpu_use.hpp"
#include "harness/measure/provenance.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/springs/reference/reference.hpp"
#include "harness/springs/studies/study.hpp"

namespace pelage::springs {

/// Returns the scene of the case `which`. Throws InputError if its topology is not a mass-spring topology.
Scene scene_with_springs(const SubjectContext& context, const Case& which);

/// Returns the scene's mass-spring system without an initial state.
Setting setting_of(SubjectContext& context, const Scene& scene);

/// Returns the state of the scene after one second, computed with very short time steps. The result is stored
/// and used again by other cases of the same scene.
const Motions& exact_of(SubjectContext& context, const Scene& scene, const Setting& setting);

/// Returns the state at rest: every stick points along its normal, and all velocities are 0.
Motions rest_motions(const SpringNetwork& network);

/// Converts the positions and velocities of the top masses to a state of the double-precision reference.
reference::State reference_state(const SpringNetwork& network, const Motions& motions);

/// Returns the positions of the top masses after `steps` time steps of the reference, from the state `start`
/// after `first` time steps.
std::vector<glm::vec3> reference_offsets(const SpringNetwork& network, const Dynamics& dynamics,
                                         const Motions& start, long first, long steps);

/// Simulates `seconds` of motion. Each call of masses.enqueue() simulates about `look` seconds, but at least
/// one time step. After each of these calls, calls `after` with the time simulated so far, in seconds. The
/// simulation ends early if `after` returns false.
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
  /// Simulates `seconds` of motion from rest and returns the times of the computation.
  Cost from_rest(MassSprings& masses, double seconds = 1) const;

  cl::Queue queue_;
  Setting setting_;
  Identity programs_;  // hashes of the OpenCL programs that ran; the studies add them with add_programs()
};

}  // namespace pelage::springs
