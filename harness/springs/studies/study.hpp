// Subjects (timed objects) of experiments on the mass-spring solvers. They draw no picture. Some of them
// compare the results with the baselines, others with a simulation that has very short time steps.
#pragma once
#include <memory>

#include "harness/cl/buffer.hpp"
#include "harness/measure/subject.hpp"
#include "harness/springs/baselines/baselines.hpp"

namespace pelage::springs {

/// The mass-spring system of one case of an experiment. Only make_solver() and
/// make_solver_against_baselines() set `start`, the initial state. To compute `start`, the device simulates
/// the motion from rest. The scene's key dynamics.time is the duration of this motion in seconds.
struct Setting {
  SpringNetwork network;
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
Motions exact_second(const SpringNetwork& network, const Dynamics& dynamics, float step);

/// These functions make the subjects of make_solver_error(), make_solver_turns(), make_solver_jacobian(), and
/// of make_solver_energy() and make_solver_drift() (`conservative`). `exact` is the exact state after one
/// second from rest. `most_error` is the largest rms error in fur lengths. solver_turns() throws InputError
/// unless it is above 0. solver_energy() throws InputError if `conservative` is true and the dynamics have
/// drag, damping, a return force, or an object that rotates or shakes.
std::unique_ptr<Subject> solver_error(const cl::Device& device, Setting setting, const Motions& exact);
std::unique_ptr<Subject> solver_turns(const cl::Device& device, const Setting& setting, const Motions& exact,
                                      double most_error);
std::unique_ptr<Subject> solver_jacobian(const cl::Device& device, Setting setting, const Motions& exact);
std::unique_ptr<Subject> solver_energy(const cl::Device& device, Setting setting, bool conservative);

/// A time step is too long if a stick reaches this many rest lengths after any step.
inline constexpr float most_stick = 2;
/// Duration, in seconds, of the simulation that tests a time step. The simulation starts at rest. In a stable
/// simulation, no stick reaches `most_stick` rest lengths.
inline constexpr double limit_seconds = 2;

struct Limit {
  /// Longest stable time step in seconds, with a relative error of at most 2%. Steps above 1 s are not tried.
  /// The value is 0 if even a step of about 15 us is too long.
  double step = 0;
  double longest = 0;  ///< greatest length of a stick in the simulation with `step`, in rest lengths
  int tried = 0;       ///< number of time steps that were tried
};

/// Finds the longest stable time step by bisection. After every step, the kernels compare the length of every
/// stick with `most_stick`. The host reads the outcome about every `look` seconds of simulated time, which
/// only determines how soon an unstable simulation ends.
Limit longest_step(const cl::Queue& queue, const SpringNetwork& network, const Dynamics& dynamics,
                   double look = 1.0 / 60);

struct Shape {
  /// Median, smallest and largest angle between a stick and the surface normal at its base, in degrees.
  double lean_median = 0, lean_least = 0, lean_most = 0;
  /// Smallest height of a top mass above the tangent plane of the surface at the stick's base, in fur
  /// lengths. The value is negative if the mass has moved through the surface.
  double height_least = 0;
  /// Median and largest gap, in fur lengths. The gap at a surface point is the largest distance between the
  /// tops of two sticks at this point. Both are 0 if no point has several sticks.
  double gap_median = 0, gap_most = 0;
  std::size_t gap_points = 0;  ///< number of surface points with several sticks
};

/// Computes the shape. For each stick, `offset` holds the position of the top relative to the base, in R.
Shape shape_of(const SpringNetwork& network, const std::vector<glm::vec3>& offset);

/// Adds the metrics `gap_median` and `gap_most` to the row, if any surface point has several sticks.
void describe_gap(const Shape& shape, Row& row);

}  // namespace pelage::springs
