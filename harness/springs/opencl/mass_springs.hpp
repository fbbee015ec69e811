// Simulates a mass-spring topology on an OpenCL device.
#pragma once
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/contact/opencl/contact_stage.hpp"
#include "harness/springs/model/dynamics.hpp"
#include "harness/springs/model/layout.hpp"
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

/// Buffers that all solvers share. The float buffers have columns (Layout), except `speed` of the topology
/// prisms, which has a row of four floats per stick (x, y, z and 0).
struct Buffers {
  /// Wind, gravity and the object's motion at each half step, from index params.first_moment on.
  cl::Buffer<Moment> moments;
  cl::Buffer<float> sites, push, offset, speed;
  /// For each place, the number of the first step after which the top had diverged (diverged() in
  /// kernels/springs/equations.clh).
  cl::Buffer<std::int32_t> diverged_at;
  cl::Buffer<std::int32_t> first;  ///< one value: the minimum of all values of diverged_at
};

/// Returns the build options that define the kernels' macros LANES and TURNING. `turning` is true if the
/// object rotates.
std::string build_options(int lanes, bool turning);

/// Computes time steps of all topologies but prisms. One launch computes all substeps of all sticks. If
/// `whole` is set, the launch has a single work-item.
class BlockStage {
 public:
  BlockStage(const cl::Queue& queue, const Layout& layout, const Dynamics& dynamics, int lanes, bool whole,
             const MassSpringOptions& options);
  void enqueue(const cl::Queue& queue, TopologyParams params, const Buffers& buffers,
               std::vector<cl::Event>* launches);
  /// Sets the rest lengths of the triangles' sides.
  void set_skin(const cl::Queue& queue, const Layout& layout);
  std::size_t bytes() const { return sides_.size() * sizeof(float); }
  const cl::Program& program() const { return program_; }

 private:
  cl::Program program_;
  cl::Kernel frame_;
  cl::Buffer<float> sides_;
  std::size_t group_;
  int blocks_, units_, per_item_;
};

/// Computes time steps of the topology prisms. Explicit solvers need one launch per evaluation of the forces,
/// and conjugate gradients three per iteration. If `whole` is set, one work-item computes all steps of the
/// whole model in one launch, except a single explicit or semi-implicit Euler step, which has many
/// work-items.
class PrismStage {
 public:
  PrismStage(const cl::Queue& queue, const Layout& layout, const Dynamics& dynamics, int lanes, bool whole,
             const MassSpringOptions& options);
  /// Sets the positions of the tops relative to their bases, stored like Layout::offset. Resets the initial
  /// guess of conjugate gradients to 0.
  void set(const cl::Queue& queue, const Layout& layout, const std::vector<float>& offset);
  /// Sets the positions of the bases and the rest lengths of the springs. `offset` has the positions of the
  /// tops relative to their bases, stored like Layout::offset.
  void set_skin(const cl::Queue& queue, const Layout& layout, const std::vector<float>& offset);
  /// Enqueues params.substeps steps. Waits for the queue whenever conjugate gradients test their residual.
  void enqueue(const cl::Queue& queue, TopologyParams params, Buffers& buffers,
               std::vector<cl::Event>* launches);
  /// The tops in rows of four floats: their positions, or with backward Euler relative to their bases.
  const cl::Buffer<float>& tops() const { return solver_.implicit ? reach_ : tip_; }
  bool tops_on_skin() const { return !solver_.implicit; }  ///< tops() contains positions
  const LinearSolves& solves() const { return solves_; }
  std::size_t bytes() const;
  const cl::Program& program() const { return program_; }

 private:
  void euler(const cl::Queue& queue, const TopologyParams& params, Buffers& buffers, int substep);
  void stages(const cl::Queue& queue, const TopologyParams& params, Buffers& buffers, int substep);
  void backward_euler(const cl::Queue& queue, const TopologyParams& params, Buffers& buffers, int substep);
  bool converged(const cl::Queue& queue);
  void whole(const cl::Queue& queue, const TopologyParams& params, Buffers& buffers);
  void whole_gradients(const cl::Queue& queue, const TopologyParams& params, Buffers& buffers);
  void launch(const cl::Queue& queue, const cl::Kernel& kernel, int items) const;

  std::vector<cl::Event>* launches_ = nullptr;  // of enqueue(); launch() appends its event unless it is null

  Solver solver_;
  bool whole_;
  double residual_;
  int most_iterations_;
  cl::Program program_;
  std::vector<cl::Kernel> kernels_;  // in the order of kernels_of() in stages.cpp
  std::size_t group_;
  int units_, per_item_, per_chunk_, chunks_;
  bool double_sums_;
  int expected_ = 4;  // iterations that run before the first convergence test of a step
  double last_residual_ = 0;
  LinearSolves solves_;
  cl::Buffer<std::int32_t> start_, neighbour_;
  cl::Buffer<float> rest_;
  // These buffers have a row of four floats for each place. Explicit solvers read tip_, the positions of the
  // tops. Backward Euler reads root_, those of the bases, and reach_, those of the tops relative to the
  // bases.
  cl::Buffer<float> tip_, other_tip_, other_speed_, root_, reach_;
  // Buffers of the RK4 solver. spare_tip_ and spare_speed_ hold rows of four floats.
  cl::Buffer<float> spare_tip_, spare_speed_, stage_offset_, sum_offset_, sum_speed_;
  // Buffers of conjugate gradients for A x = b: the 3 x 3 diagonal blocks of A and their inverses, for each
  // spring a vector that determines its off-diagonal block, the solution x (change_), the residual r (left_),
  // the search direction d (way_), and along_, which first holds the product A d and later in the iteration
  // the preconditioned residual z. change_ and way_ have rows of four floats.
  cl::Buffer<float> diagonal_, inverse_, coupling_, change_, left_, way_, along_;
  cl::Memory sums_;
  cl::Buffer<float> solved_;  // results of gradients_whole
};

class MassSprings {
 public:
  /// Creates the system at rest. Throws InputError if check() of dynamics.hpp rejects `dynamics`, if
  /// options.lanes is not valid, or for backward Euler with dynamics.full_jacobian.
  MassSprings(const cl::Queue& queue, const SpringNetwork& network, const Dynamics& dynamics,
              const MassSpringOptions& options = {});

  /// Sets the state of all tops: their positions relative to their bases in R, and their velocities in R/s.
  /// `steps` is the number of steps from rest to this state. Clears the record of diverged masses, and sets
  /// the initial guess of conjugate gradients to 0. Throws InputError if a size is wrong, a value is not
  /// finite or `steps` is out of range.
  void set(const cl::Queue& queue, const std::vector<glm::vec3>& offsets,
           const std::vector<glm::vec3>& speeds, long steps = 0);

  /// Sets the time step of all later steps, in seconds. Keeps the count of the steps done; set() can change
  /// this count. Throws InputError if check() of dynamics.hpp rejects the new time step.
  void retime(float step);

  /// Sets gravity and wind of all later steps. `network` is that of the constructor. Throws InputError if
  /// check() of dynamics.hpp rejects `dynamics`.
  void set_forces(const cl::Queue& queue, const SpringNetwork& network, const Dynamics& dynamics);

  /// Places the sticks on the skin of `network`, at the start of a frame of a moving skin (docs/springs.md).
  /// The topology is that of the constructor. `change` is what the velocity of each base changes by, in R/s.
  /// The tops keep their positions relative to their bases, and their velocities in the world.
  void set_skin(const cl::Queue& queue, const SpringNetwork& network, const std::vector<glm::vec3>& change);

  /// Sets the local forces on the tops, one vector per stick, in newtons, in the object's frame; empty: none.
  /// Throws InputError if the size is wrong or a force is not finite.
  void push(const cl::Queue& queue, const std::vector<glm::vec3>& force);

  /// After each later step, the colliders of `scene` push the tops. The step number i of a call of enqueue()
  /// ends at the time number i of contact().
  void collide(const cl::Queue& queue, const Scene& scene, const ContactFields& fields);
  /// Returns the colliders; null without colliders.
  ContactStage* contact() { return contact_ ? &contact_->stage : nullptr; }
  const cl::Program* contact_program() const { return contact_ ? &contact_->program : nullptr; }

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
  const cl::Buffer<float>& offset() const { return buffers_.offset; }
  std::vector<std::int32_t> offset_columns() const;
  long steps() const { return steps_; }            ///< number of steps done or enqueued
  float length() const { return params_.length; }  ///< length of the fur in R
  std::size_t bytes() const;  ///< of device memory; the same number as memory() of layout.hpp
  const LinearSolves& solves() const;
  const cl::Program& program() const;  ///< program of the solver's kernels

 private:
  void upload_moments(const cl::Queue& queue, int substeps);
  void launch_steps(const cl::Queue& queue, const TopologyParams& params, std::vector<cl::Event>* launches);
  void launch_contact(const cl::Queue& queue, int time, std::vector<cl::Event>* launches);
  std::vector<glm::vec3> by_stick(const cl::Queue& queue, const cl::Buffer<float>& buffer, bool rows) const;

  struct Contact {
    ContactStage stage;
    cl::Program program;
    cl::Kernel kernel;
  };

  int lanes_;
  std::optional<Contact> contact_;
  Dynamics dynamics_;
  Layout layout_;
  TopologyParams params_;
  Buffers buffers_;
  std::optional<BlockStage> blocks_;
  std::optional<PrismStage> prisms_;
  long steps_ = 0;
  // The device holds wind, gravity and the object's motion for the steps from known_from_ to known_to_ - 1.
  long known_from_ = 0, known_to_ = 0;
};

/// Advances a mass-spring system frame by frame. Computes frames of equal duration, each in n equal steps
/// and, from the same state, again in 2 * n steps. If the results differ by more than the tolerance, or if
/// one of them diverges, n is doubled and the frame is repeated. Otherwise the result of 2 * n steps is kept.
/// If the difference is less than a quarter of the tolerance, the next frame starts with n / 2, because the
/// doubled error of a first-order scheme still meets the tolerance. A frame without repetition takes three
/// times as long as n steps, plus transfers of the state to the host and back.
class AdaptiveSteps {
 public:
  /// `span` is the duration of a frame in seconds. `steps` is the value of n for the first frame. `tolerance`
  /// is the greatest difference between the results of n and of 2 * n steps: the 99th percentile of the
  /// distances of the tops, as a fraction of the fur's length. `most` is the largest value of 2 * n. Throws
  /// InputError unless `span` and `tolerance` are above 0 and 1 <= steps <= most.
  AdaptiveSteps(float span, int steps, float tolerance, int most = 4096);

  struct Frame {
    int steps = 0;     ///< number of steps of the kept result
    double error = 0;  ///< its difference from the result of half as many steps
  };
  /// Computes the next frame. `masses` must be at rest (first call) or in the state that the previous call
  /// left. Throws Diverged or InputError if `most` steps do not suffice.
  Frame advance(const cl::Queue& queue, MassSprings& masses, std::vector<cl::Event>* launches = nullptr);

 private:
  float span_, tolerance_;
  int steps_, most_;
  long frame_ = 0;
};

}  // namespace pelage::springs
