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

/// Makes a subject that times the steps of one frame on the device and, if `rivals` is set, with every
/// baseline. All runs start from `setting.start` and run one after the other.
std::unique_ptr<Subject> solver_duel(const cl::Device& device, Setting setting, int substeps, bool rivals);

/// Makes a subject that times one simulated second from rest. Its error metrics are the distances of the top
/// masses from `exact`, the exact state after this second.
std::unique_ptr<Subject> solver_error(const cl::Device& device, Setting setting, const Motions& exact);

/// Returns the state after one second from rest, computed in double precision by RK4 with steps of `step`
/// seconds.
Motions exact_second(const SpringNetwork& topology, const Dynamics& dynamics, float step);

/// Makes a subject that finds the longest stable time step. A time step is stable if no stick reaches twice
/// its rest length in two simulated seconds from rest; the lengths are tested every half second. The metric
/// is "longest_step_ms".
std::unique_ptr<Subject> solver_limit(const cl::Device& device, Setting setting);

/// Makes a subject that simulates four seconds from rest. It reports the energy of springs and masses at
/// several times. The metric for each time is named "energy_uJ_at_<seconds>", with the simulated time in
/// seconds.
std::unique_ptr<Subject> solver_energy(const cl::Device& device, Setting setting);

}  // namespace pelage::springs
