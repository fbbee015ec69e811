// Subjects (timed objects) of experiments on the mass-spring solvers. They draw no picture. Some of them
// compare the results with the baselines, others with a simulation that has very short time steps.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "harness/cl/device.hpp"
#include "harness/measure/subject.hpp"
#include "harness/springs/baselines/baselines.hpp"
#include "harness/springs/opencl/mass_springs.hpp"

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

/// Makes a subject that times the steps of one frame on the device and, if `baselines` is set, in turns with
/// every baseline solver. All start from `setting.start`.
std::unique_ptr<Subject> solver_frames(const cl::Device& device, Setting setting, int substeps,
                                       bool baselines);

/// Makes a subject that times one simulated second from rest. Its error metrics are the distances of the top
/// masses from `exact`, the exact state after this second.
std::unique_ptr<Subject> solver_error(const cl::Device& device, Setting setting, const Motions& exact);

/// Returns the state after one second from rest, computed in double precision by RK4 with steps of `step`
/// seconds.
Motions exact_second(const SpringNetwork& topology, const Dynamics& dynamics, float step);

/// Makes a subject that finds the longest stable time step with longest_step() of limit.hpp. The metric
/// "longest_step_ms" is this time step. The metric "longest_stick" is the greatest length of a stick in a
/// simulation with this time step, in rest lengths.
std::unique_ptr<Subject> solver_limit(const cl::Device& device, Setting setting);

/// Makes a subject that simulates four seconds from rest and reports energies at several times. If
/// `conservative` is false, the metrics "energy_uJ_at_<seconds>" are the kinetic energy of the masses plus
/// the potential energy of the springs. If `conservative` is true, the metrics "total_energy_uJ_at_<seconds>"
/// also include the potential energy of gravity. The metric "drift" is then the change of this total energy
/// over the four seconds, divided by the energy that all masses would release if they fell by the fur's
/// length. If `conservative` is true and the dynamics have drag, damping, a return force, or an object that
/// rotates or shakes, the function throws InputError.
std::unique_ptr<Subject> solver_energy(const cl::Device& device, Setting setting, bool conservative);

/// Makes a subject that simulates `seconds` from rest. It reports the angles of the sticks to the surface
/// normals, and the gaps between the sticks at one surface point (shape.hpp).
std::unique_ptr<Subject> solver_shape(const cl::Device& device, Setting setting, double seconds);

/// Makes a subject that runs all solvers alternately; each solver simulates one second from rest. Each solver
/// takes the smallest number of steps per frame (1/60 s) with which its rms error is at most `most_error` fur
/// lengths. The metrics include the time step and the errors of each solver, for instance "rk4_error_p99".
std::unique_ptr<Subject> solver_turns(const cl::Device& device, Setting setting, const Motions& exact,
                                      double most_error);

/// Makes a subject that simulates one second from rest twice. Both simulations use backward Euler in double
/// precision, the first with the pruned Jacobian and the second with the full Jacobian. The metrics are the
/// errors of the two simulations.
std::unique_ptr<Subject> solver_jacobian(const cl::Device& device, Setting setting, const Motions& exact);

}  // namespace pelage::springs
