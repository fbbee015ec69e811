// Simulates strands on an OpenCL device.
#pragma once
#include <memory>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/strands/chain/chain.hpp"

namespace pelage::strands {

struct ChainOptions {
  int lanes = 0;            ///< strands that a work-item computes at a time: 1 or 16; 0: the device's default
  int slices_per_item = 0;  ///< slices of 16 strands per work-item; 0: the device's default
};

class Chains {
 public:
  /// Creates the strands at rest at time 0 (at_rest() of chain.hpp). Throws InputError if a value is not
  /// valid.
  Chains(const cl::Queue& queue, const std::vector<Chain>& chains, const ChainDynamics& dynamics,
         const ChainOptions& options = {});

  /// Enqueues `substeps` steps in one launch. Appends the event of the launch to `launches` unless it is
  /// null.
  void enqueue(const cl::Queue& queue, int substeps, std::vector<cl::Event>* launches = nullptr);

  /// Sets the states of all strands. `steps` is the number of steps from the start to these states. Throws
  /// InputError if the number of states is wrong.
  void set(const cl::Queue& queue, const std::vector<ChainState>& states, long steps = 0);

  /// Replaces gravity, wind and motion for all later steps. The duration of a step and the constants of the
  /// chains stay. Throws InputError if an object that did not rotate begins to rotate, because the program
  /// was built without rotation.
  void retarget(const ChainDynamics& dynamics);

  std::vector<ChainState> states(const cl::Queue& queue) const;
  /// Enqueues the conversion of the present states to key strands: KEY_RECORD floats each
  /// (kernels/strands/draw/params.h). The key strands are in the object's frame. `keys` must have room for
  /// the number of strands, rounded up to a multiple of 16. Appends the event of the launch to `launches`
  /// unless it is null. Throws InputError if `keys` is too small.
  void write_keys(const cl::Queue& queue, const cl::Buffer<float>& keys,
                  std::vector<cl::Event>* launches = nullptr);
  const cl::Buffer<float>& buffer() const { return states_; }  ///< the table of states, CHAIN_COLUMNS columns
  long steps() const { return steps_; }
  std::vector<const cl::Program*> programs() const { return {&program_, &key_program_}; }

 private:
  std::size_t strands_;
  ChainDynamics dynamics_;
  ChainParams params_;
  int lanes_;
  cl::Program program_, key_program_;
  cl::Kernel frame_, write_keys_;
  cl::Buffer<float> constants_, states_;
  cl::Buffer<ChainMoment> moments_, present_;
  long steps_ = 0;
  long known_from_ = 0,
       known_to_ = 0;  // the device has gravity, wind and motion of the steps known_from_ to known_to_ - 1
};

}  // namespace pelage::strands
