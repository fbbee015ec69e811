// Subjects (timed objects) of experiments on the mass-spring solvers. They draw no picture. Their results are
// compared with the baselines or with runs that have shorter time steps.
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

/// The mass-spring system of one case of an experiment. `start` is its initial state, which the device
/// computes by simulating `dynamics.time` seconds (a key of the scene) from rest.
struct Setting {
  SpringNetwork topology;
  Dynamics dynamics;
  Motions start;
  long steps = 0;  ///< number of time steps from rest to `start`
};

/// These functions make the subjects described in docs/topology.md, section Studies, from the scene of the
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

/// Makes a subject that times the steps of one frame on the device and, if `rivals` is set, with every
/// baseline. All runs start from `setting.start` and run one after the other.
std::unique_ptr<Subject> solver_duel(const cl::Device& device, Setting setting, int substeps, bool rivals);

/// Makes a subject that times one simulated second from rest. Its error metrics are the distances of the top
/// masses from `exact`, the exact state after this second.
std::unique_ptr<Subject> solver_error(const cl::Device& device, Setting setting, const Motions& exact);

/// Returns the state after one second from rest, computed in double precision by RK4 with steps of `step`
/// seconds.
Motions exact_second(const SpringNetwork& topology, const Dynamics& dynamics, float step);

/// Makes a subject that finds the longest stable time step with longest_step() of limit.hpp. The metrics are
/// "longest_step_ms" and "longest_stick", the length of the longest stick with this time step.
std::unique_ptr<Subject> solver_limit(const cl::Device& device, Setting setting);

/// Makes a subject that simulates four seconds from rest and reports energies at several times. With
/// `conservative` unset, the metric "energy_uJ_at_<seconds>" is the energy of springs and masses, which wind
/// and drag change. With `conservative` set, "total_energy_uJ_at_<seconds>" includes the potential energy of
/// the weights, and "drift" is its change over the four seconds. The function then throws InputError if the
/// dynamics have drag, damping, a return force or a moving object.
std::unique_ptr<Subject> solver_energy(const cl::Device& device, Setting setting, bool conservative);

/// Makes a subject that simulates `seconds` from rest and reports the shape of the fur (shape.hpp): the lean
/// of the sticks, and the gaps between the sticks of one surface point.
std::unique_ptr<Subject> solver_shape(const cl::Device& device, Setting setting, double seconds);

/// Makes a subject that lets all solvers simulate one second from rest in turns. Each solver takes as few
/// steps per frame (1/60 s) as it needs for an rms error of at most `most_error` fur lengths. The metrics
/// name solver, norm and step, such as "rk4_error_p99".
std::unique_ptr<Subject> solver_turns(const cl::Device& device, Setting setting, const Motions& exact,
                                      double most_error);

/// Makes a subject that simulates one second from rest with the double-precision reference by backward Euler,
/// once with the pruned and once with the full Jacobian. The metrics are the errors of both.
std::unique_ptr<Subject> solver_jacobian(const cl::Device& device, Setting setting, const Motions& exact);

}  // namespace pelage::springs
