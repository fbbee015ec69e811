// The parts of MassSprings: the buffers that all solvers share, and two classes that enqueue kernels, for the
// topology prisms and for all others.
#pragma once
#include <string>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/springs/model/layout.hpp"
#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {

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

  std::vector<cl::Event>* launches_ = nullptr;  // of enqueue(); launch() appends its event unless it is null

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

}  // namespace pelage::springs
