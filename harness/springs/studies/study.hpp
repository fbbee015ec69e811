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
  Topology topology;
  Dynamics dynamics;
  Motions start;
  long steps = 0;  ///< done by then
};

/// Cases whose pipeline is "springs", "springs+rivals", "springs-error", "springs-limit" or "springs-energy"
/// (docs/topology.md, Experiments) go to a subject of this room, all others to `others`. A case whose scene
/// names no topology throws InputError; a mass that is lost throws OutOfBounds.
MakeSubject with_solvers(const MakeSubject& others, const cl::Device& device, const Experiment& experiment,
                         const std::function<void(const std::string&)>& progress);

/// A frame's substeps on the device and by every rival, one after the other, all from the setting's state.
std::unique_ptr<Subject> solver_duel(const cl::Device& device, Setting setting, int substeps, bool rivals);

/// A simulated second from rest, timed; its error against a run in double with RK4 at 1/8 of the shortest
/// stable step.
std::unique_ptr<Subject> solver_error(const cl::Device& device, Setting setting, const Motions& exact);

/// The state after a second from rest, in double, by RK4 with `step`.
Motions exact_second(const Topology& topology, const Dynamics& dynamics, float step);

/// The longest step with which two seconds from rest leave every stick shorter than twice its length: metric
/// "longest_step_ms".
std::unique_ptr<Subject> solver_limit(const cl::Device& device, Setting setting);

/// Four seconds from rest: the springs' and the masses' energy over time as metrics "energy_uJ_at_<s>".
std::unique_ptr<Subject> solver_energy(const cl::Device& device, Setting setting);

}  // namespace pelage::springs
