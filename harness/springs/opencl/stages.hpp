// What MassSprings is made of: the buffers that every solver shares, and the launches of each.
#pragma once
#include <string>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/springs/model/layout.hpp"
#include "harness/springs/opencl/mass_springs.hpp"

namespace pelage::springs {

/// Columns per place, as places.clh lays them out; on shared prisms speed lies in rows of four.
struct Buffers {
  cl::Buffer<Moment> moments;  ///< from params.first_moment on of the launch in hand
  cl::Buffer<float> sites, push, offset, speed;
  cl::Buffer<std::int32_t> diverged_at;  ///< per place, the first step after which the mass was lost
  cl::Buffer<std::int32_t> first;        ///< one: the least of those
};

/// "-D NAME=value" for a build at `lanes` lanes; turning: the object turns.
std::string build_options(int lanes, bool turning);

/// How many units (16 / LANES to a slice) one work-item goes through; `wanted`: slices, 0 for the device's
/// own.
int units_per_item(const cl::DeviceInfo& device, int lanes, int units, int wanted);

/// Work-items of a work-group. A CPU's work-item is a long loop of its own, and its drivers compile a kernel
/// anew for every size of group: one size, 1, is enough. A GPU's takes 64.
std::size_t group_size(int lanes, std::size_t wanted);

/// Sticks, separable sticks, separable prisms: one launch takes every block through all substeps, whole: by
/// one work-item.
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

/// Shared prisms: a launch per evaluation of the forces, and three per iteration of conjugate gradients; or
/// one launch of one work-item for the whole model and all steps.
class PrismStage {
 public:
  PrismStage(const cl::Queue& queue, const Layout& layout, const Dynamics& dynamics, int lanes, bool whole,
             const MassSpringOptions& options);
  /// Other offsets, columns as the layout's; what follows from them, and conjugate gradients from the start.
  void set(const cl::Queue& queue, const Layout& layout, const std::vector<float>& offset);
  /// Waits for the queue where conjugate gradients have to be tested.
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

  std::vector<cl::Event>* launches_ = nullptr;  // where they are noted during enqueue(), if anywhere

  Solver solver_;
  bool whole_;
  double residual_;
  int most_iterations_;
  cl::Program program_;
  std::vector<cl::Kernel> kernels_;  // in the order of their names in prism_stage.cpp
  std::size_t group_;
  int units_, per_item_, per_chunk_, chunks_;
  bool double_sums_;
  int expected_ = 4;  // iterations of the step before
  double last_residual_ = 0;
  LinearSolves solves_;
  cl::Buffer<std::int32_t> start_, neighbour_;
  cl::Buffer<float> rest_;
  cl::Buffer<float> tip_, other_tip_, other_speed_;                                    // rows
  cl::Buffer<float> spare_tip_, spare_speed_, stage_offset_, sum_offset_, sum_speed_;  // rk4: two of rows
  // A's blocks, their inverses and couplings; x (rows), r, d (rows), A d and then z
  cl::Buffer<float> diagonal_, inverse_, coupling_, change_, left_, way_, along_;
  cl::Memory sums_;
  cl::Buffer<float> solved_;  // of gradients_whole
};

}  // namespace pelage::springs
