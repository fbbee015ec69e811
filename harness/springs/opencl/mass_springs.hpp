// Simulates a mass-spring topology on an OpenCL device.
#pragma once
#include <memory>
#include <stdexcept>

#include "harness/cl/program.hpp"
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

/// Thrown if a mass diverged. Typical causes are a time step that is too long for the stiffness, and very
/// large forces.
struct Diverged : std::runtime_error {
  Diverged(long step_number, std::size_t mass_number, const Dynamics& dynamics);
  long step;         ///< number (from 0) of the first step after which a mass had diverged
  std::size_t mass;  ///< index of this mass; the lowest index if several masses diverged
};

struct MassSpringOptions {
  /// Number of sticks or triangles that a work-item computes at a time: 1 or 16. 0 selects the device's
  /// default.
  int lanes = 0;
  std::size_t group = 0;    ///< work-items per work-group; 0: usual_group() of harness/cl
  int blocks_per_item = 0;  ///< slices of 16 sticks or triangles per work-item; 0: device's default
  /// Whether one work-item computes all steps of a launch for the whole model: on a CPU this is faster for a
  /// small model, because waking a second core takes more time than it saves.
  enum class Whole { as_suits, never, always } whole = Whole::as_suits;
};

/// Returns true if a single work-item should compute the whole model: only on a CPU, and only if the model
/// has few sticks. The option Whole::as_suits uses this function.
bool whole_suits(const cl::DeviceInfo& device, Kind kind, Solver solver, std::size_t sticks);

/// Statistics of the linear systems A x = b that a MassSprings object has solved by conjugate gradients.
struct LinearSolves {
  long solves = 0, iterations = 0;
  int most_iterations = 0;    ///< largest number of iterations of one solve
  double worst_residual = 0;  ///< largest |r| / |b| after a solve; r is the recursively updated residual
};

class MassSprings {
 public:
  /// Creates the system at rest. Throws InputError if check() of dynamics.hpp rejects `dynamics`, if
  /// options.lanes is not valid, or for backward Euler with dynamics.full_jacobian.
  MassSprings(const cl::Queue& queue, const SpringNetwork& topology, const Dynamics& dynamics,
              const MassSpringOptions& options = {});
  ~MassSprings();
  MassSprings(MassSprings&&) noexcept;
  MassSprings& operator=(MassSprings&&) noexcept;

  /// Sets the state of all tops: their positions relative to their bases in R, and their velocities in R/s.
  /// `steps` is the number of steps from rest to this state. Clears the record of diverged masses, and sets
  /// the initial guess of conjugate gradients to 0. Throws InputError if a size is wrong, a value is not
  /// finite or `steps` is out of range.
  void set(const cl::Queue& queue, const std::vector<glm::vec3>& offsets,
           const std::vector<glm::vec3>& speeds, long steps = 0);

  /// Sets the time step of all later steps, in seconds. Keeps the count of the steps done; set() can change
  /// this count. Throws InputError if check() of dynamics.hpp rejects the new time step.
  void retime(float step);

  /// Sets the local forces on the tops, one vector per stick, in newtons, in the object's frame; empty: none.
  /// Throws InputError if the size is wrong or a force is not finite.
  void push(const cl::Queue& queue, const std::vector<glm::vec3>& force);

  /// Enqueues `substeps` steps. The call may wait for the upload of wind and motion, and waits for the queue
  /// whenever conjugate gradients test their residual. Appends the event of every launch to `launches` unless
  /// it is null.
  void enqueue(const cl::Queue& queue, int substeps, std::vector<cl::Event>* launches = nullptr);

  /// Waits for the queue. Throws Diverged if a mass diverged in a step enqueued so far.
  void check(const cl::Queue& queue) const;

  /// Calls enqueue() and then check().
  void advance(const cl::Queue& queue, int substeps);

  std::vector<glm::vec3> offsets(const cl::Queue& queue) const;  ///< tops relative to their bases, R
  std::vector<glm::vec3> speeds(const cl::Queue& queue) const;   ///< velocities of the tops, R/s
  /// The device buffer of the offsets, and for each stick the index of x in this buffer. y is stored 16
  /// floats after x, and z 32 floats after x.
  const cl::Buffer<float>& offset() const;
  std::vector<std::int32_t> offset_columns() const;
  long steps() const;         ///< number of steps done or enqueued
  float length() const;       ///< length of the fur in R
  std::size_t bytes() const;  ///< of device memory; the same number as memory() of layout.hpp
  const LinearSolves& solves() const;
  const cl::Program& program() const;  ///< program of the solver's kernels

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pelage::springs
