// Subjects (timed objects) of experiments on the mass-spring solvers. They draw no picture. Some of them
// compare the results with the baselines, others with a simulation that has very short time steps.
#pragma once
#include <memory>

#include "harness/cl/device.hpp"
#include "harness/measure/subject.hpp"
#include "harness/springs/baselines/baselines.hpp"

namespace pelage::springs {

/// The mass-spring system of one case of an experiment. Only make_solver() and
/// make_solver_against_baselines() set `start`, the initial state. To compute `start`, the device simulates
/// the motion from rest. The scene's key dynamics.time is the duration of this motion in seconds.
struct Setting {
  SpringNetwork topology;
  Dynamics dynamics;
  Motions start;
  long steps = 0;  ///< number of time steps from rest to `start`
};

/// These functions make the subjects described in docs/springs.md, section Studies, from the scene of the
/// case `which`. They throw InputError if the scene's topology is not a mass-spring topology. The subjects
/// throw OutOfBounds if a mass diverges.
std::unique_ptr<Subject> make_solver(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_against_baselines(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_error(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_limit(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_energy(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_drift(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_shape(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_turns(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_jacobian(SubjectContext& context, const Case& which);

/// Returns the state after one second from rest, computed in double precision by RK4 with steps of `step`
/// seconds.
Motions exact_second(const SpringNetwork& topology, const Dynamics& dynamics, float step);

/// These functions make the subjects of make_solver_error(), make_solver_turns(), make_solver_jacobian(), and
/// of make_solver_energy() and make_solver_drift() (`conservative`). `exact` is the exact state after one
/// second from rest. `most_error` is the largest rms error in fur lengths. solver_turns() throws InputError
/// unless it is above 0. solver_energy() throws InputError if `conservative` is true and the dynamics have
/// drag, damping, a return force, or an object that rotates or shakes.
std::unique_ptr<Subject> solver_error(const cl::Device& device, Setting setting, const Motions& exact);
std::unique_ptr<Subject> solver_turns(const cl::Device& device, Setting setting, const Motions& exact,
                                      double most_error);
std::unique_ptr<Subject> solver_jacobian(const cl::Device& device, Setting setting, const Motions& exact);
std::unique_ptr<Subject> solver_energy(const cl::Device& device, Setting setting, bool conservative);

}  // namespace pelage::springs
