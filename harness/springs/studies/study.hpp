// Solvers of the mass-spring topologies as subjects of the harness: they move, draw nothing, and are held
// against rivals and against finer runs.
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

/// What moves in a case, and from which state: `time` s of its scene's dynamics have passed, by the device.
struct Setting {
  SpringNetwork topology;
  Dynamics dynamics;
  Motions start;
  long steps = 0;  ///< done by then
};

/// The studies of docs/topology.md, Studies, of the case's scene. They throw InputError where the scene
/// names no topology, and OutOfBounds where a mass is lost.
std::unique_ptr<Subject> make_solver(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_against_baselines(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_error(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_limit(SubjectContext& context, const Case& which);
std::unique_ptr<Subject> make_solver_energy(SubjectContext& context, const Case& which);

/// A frame's substeps on the device and by every rival, one after the other, all from the setting's state.
std::unique_ptr<Subject> solver_duel(const cl::Device& device, Setting setting, int substeps, bool rivals);

/// A simulated second from rest, timed; its error against a run in double with RK4 at 1/8 of the shortest
/// stable step.
std::unique_ptr<Subject> solver_error(const cl::Device& device, Setting setting, const Motions& exact);

/// The state after a second from rest, in double, by RK4 with `step`.
Motions exact_second(const SpringNetwork& topology, const Dynamics& dynamics, float step);

/// The longest step with which two seconds from rest leave every stick shorter than twice its length: metric
/// "longest_step_ms".
std::unique_ptr<Subject> solver_limit(const cl::Device& device, Setting setting);

/// Four seconds from rest: the springs' and the masses' energy over time as metrics "energy_uJ_at_<s>".
std::unique_ptr<Subject> solver_energy(const cl::Device& device, Setting setting);

}  // namespace pelage::springs
