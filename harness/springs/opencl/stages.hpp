// The parts of MassSprings: the buffers that all solvers share, and two classes that enqueue kernels.
// PrismStage handles the topology prisms, in which adjacent prisms share their sticks. BlockStage handles all
// other topologies.
#pragma once
#include <string>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/springs/model/layout.hpp"
#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {

/// Buffers that all solvers share. A slice consists of 16 sticks. The float buffers store one slice after
/// another. In a slice, each component of a value, such as x, has a column of 16 floats (see places.clh). For
/// the topology prisms, `speed` has no columns: it stores one row of four floats per stick (x, y, z and 0).
struct Buffers {
  /// Wind, gravity and the object's motion at each half step. A launch reads the entries from index
  /// params.first_moment on.
  cl::Buffer<Moment> moments;
  cl::Buffer<float> sites, push, offset, speed;
  /// One value for each stick and for each unused place of a slice: the number of the first step after which
  /// the top mass of the stick had diverged (see diverged() in kernels/springs/equations.clh).
  cl::Buffer<std::int32_t> diverged_at;
  cl::Buffer<std::int32_t> first;  ///< one value: the minimum of all values of diverged_at
};

/// Returns the build options that define the kernels' macros LANES and TURNING. `turning` is true if the
/// object rotates.
std::string build_options(int lanes, bool turning);

/// Returns the number of units per work-item. A unit is what a work-item computes at a time. On the topology
/// separable-prisms it is `lanes` triangles. On the other topologies it is `lanes` sticks of one slice, or
/// `lanes` sticks of each of two slices. `units` is the number of units of the whole model. `wanted` is
/// MassSpringOptions::blocks_per_item, a number of slices. If `wanted` is above 0, the function returns
/// wanted * 16 / lanes. If `wanted` is 0, the function returns the device's default.
int units_per_item(const cl::DeviceInfo& device, int lanes, int units, int wanted);

/// Computes time steps of the topologies sticks, separable-sticks and separable-prisms. One launch computes
/// all substeps of all sticks. If `whole` is set, the launch has a single work-item.
class BlockStage {
 public:
  BlockStage(const cl::Queue& queue, const Layout& layout, const Dynamics& dynamics, int lanes, bool whole,
             const MassSpringOptions& options);
  void enqueue(const cl::Queue& queue, TopologyParams params, const Buffers& buffers,
               std::vector<cl::Event>* launches);
  std::size_t bytes() const { return sides_.size() * sizeof(float); }
  const cl::Program& program() const { return program_; }

 private:
  cl::Program program_;
  cl::Kernel frame_;
  cl::Buffer<float> sides_;
  std::size_t group_;
  int blocks_, units_, per_item_;
};

/// Computes time steps of the topology prisms, in which adjacent prisms share their sticks. Explicit solvers
/// need one launch per evaluation of the forces, and conjugate gradients three launches per iteration. If
/// `whole` is set, one work-item computes all steps of the whole model in one launch; an exception is a
/// launch of a single explicit or semi-implicit Euler step, which has many work-items.
class PrismStage {
 public:
  PrismStage(const cl::Queue& queue, const Layout& layout, const Dynamics& dynamics, int lanes, bool whole,
             const MassSpringOptions& options);
  /// Sets the position of each top mass relative to the stick's base to the stick's vector in `offset`.
  /// `offset` is stored like Layout::offset. Resets the initial guess of conjugate gradients to 0.
  void set(const cl::Queue& queue, const Layout& layout, const std::vector<float>& offset);
  /// Enqueues params.substeps steps. Waits for the queue whenever conjugate gradients test their residual.
  void enqueue(const cl::Queue& queue, TopologyParams params, Buffers& buffers,
               std::vector<cl::Event>* launches);
  const LinearSolves& solves() const { return solves_; }
  std::size_t bytes() const;
  const cl::Program& program() const { return program_; }

 private:
  void euler(const cl::Queue& queue, const TopologyParams& params, Buffers& buffers, int substep);
  void rk4(const cl::Queue& queue, const TopologyParams& params, Buffers& buffers, int substep);
  void backward_euler(const cl::Queue& queue, const TopologyParams& params, Buffers& buffers, int substep);
  bool converged(const cl::Queue& queue);
  void whole(const cl::Queue& queue, const TopologyParams& params, Buffers& buffers);
  void whole_gradients(const cl::Queue& queue, const TopologyParams& params, Buffers& buffers);
  void launch(const cl::Queue& queue, const cl::Kernel& kernel, int items) const;

  // enqueue() sets this pointer. If the pointer is not null, launch() appends the event of every kernel
  // launch to this list.
  std::vector<cl::Event>* launches_ = nullptr;

  Solver solver_;
  bool whole_;
  double residual_;
  int most_iterations_;
  cl::Program program_;
  std::vector<cl::Kernel> kernels_;  // in the order of kernels_of() in prism_stage.cpp
  std::size_t group_;
  int units_, per_item_, per_chunk_, chunks_;
  bool double_sums_;
  int expected_ = 4;  // iterations that run before the first convergence test of a step
  double last_residual_ = 0;
  LinearSolves solves_;
  cl::Buffer<std::int32_t> start_, neighbour_;
  cl::Buffer<float> rest_;
  // These buffers have a row of four floats for each stick and for each unused place of a slice. tip_ holds
  // the positions of the top masses, for explicit solvers. Backward Euler instead reads root_, the positions
  // of the sticks' bases, and reach_, the positions of the top masses relative to the bases.
  cl::Buffer<float> tip_, other_tip_, other_speed_, root_, reach_;
  // Buffers of the RK4 solver. spare_tip_ and spare_speed_ hold rows of four floats.
  cl::Buffer<float> spare_tip_, spare_speed_, stage_offset_, sum_offset_, sum_speed_;
  // Buffers of the solver that solves A x = b by conjugate gradients. diagonal_ holds the 3 x 3 diagonal
  // blocks of A, and inverse_ holds the inverses of these blocks. For each spring, coupling_ holds a vector
  // that determines the spring's off-diagonal block of A. change_ holds the solution x, left_ holds the
  // residual r, and way_ holds the search direction d. along_ first holds the product A d. Later in the
  // iteration, along_ holds the preconditioned residual z. change_ and way_ have rows of four floats.
  cl::Buffer<float> diagonal_, inverse_, coupling_, change_, left_, way_, along_;
  cl::Memory sums_;
  cl::Buffer<float> solved_;  // results of gradients_whole
};

}  // namespace pelage::springs
