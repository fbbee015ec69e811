// Simulates strands on an OpenCL device.
#pragma once
#include <optional>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/contact/opencl/contact_stage.hpp"
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

  /// Enqueues `substeps` steps in one launch. Appends the event of the launch to `events`, in the phase
  /// simulate, unless it is null.
  void enqueue(const cl::Queue& queue, int substeps, cl::PhaseEvents* events = nullptr);

  /// Sets gravity and wind of all later steps. `chains` are those of the constructor. Throws InputError if a
  /// value is not valid.
  void set_forces(const cl::Queue& queue, const std::vector<Chain>& chains, const ChainDynamics& dynamics);

  /// Sets the states of all strands. `steps` is the number of steps from the start to these states. Throws
  /// InputError if the number of states is wrong.
  void set(const cl::Queue& queue, const std::vector<ChainState>& states, long steps = 0);

  /// The next `substeps` steps follow a skin that moves and deforms: the strands' roots move from `from` to
  /// `to`, in the world. Directions, velocities and accelerations are interpolated linearly. The call
  /// replaces ChainDynamics::motion, which must then be the default, and the roots, directions at rest and
  /// normals of the chains. The phases of the gusts stay. Before each later step beyond these `substeps`,
  /// set_skin() must be called again. The first call builds a program. Throws InputError if a value is not
  /// valid, or if ChainDynamics::body is not null.
  void set_skin(const cl::Queue& queue, const SkinFrame& from, const SkinFrame& to, int substeps);

  /// After each later step, the colliders of `scene` push the strands. The step number i of a call of
  /// enqueue() ends at the time number i of contact(). The object and its skin must not move.
  void collide(const cl::Queue& queue, const Scene& scene, const ContactFields& fields);
  ContactStage* contact() { return contact_ ? &contact_->stage : nullptr; }  ///< null without colliders

  std::vector<ChainState> states(const cl::Queue& queue) const;
  /// Enqueues the conversion of the present states to key strands: KEY_RECORD floats each
  /// (kernels/strands/draw/params.h). The key strands are in the object's frame. With set_skin(), they are in
  /// the world and have the roots, normals and directions at rest of the frame `to`. `keys` must have room
  /// for the number of strands, rounded up to a multiple of 16. Appends the event of the launch to `events`,
  /// in the phase keys, unless it is null. Throws InputError if `keys` is too small.
  void write_keys(const cl::Queue& queue, const cl::Buffer<float>& keys, cl::PhaseEvents* events = nullptr);
  const cl::Buffer<float>& buffer() const { return states_; }  ///< the table of states, CHAIN_COLUMNS columns
  long steps() const { return steps_; }
  std::vector<const cl::Program*> programs() const;

 private:
  /// The two frames of the skin between which the strands move, and the kernel that follows them.
  struct MovingSkin {
    MovingSkin(const cl::Device& device, const cl::ProgramText& text, std::size_t room);
    cl::Program program;
    cl::Kernel frame;
    cl::Buffer<float> from, to, some_from, some_to;
    long first_step = 0, last_step = 0;  ///< the frames are those of the steps first_step to last_step - 1
  };

  struct Contact {
    ContactStage stage;
    cl::Program program;
    cl::Kernel kernel;
  };
  void launch(const cl::Queue& queue, const ChainParams& params, cl::PhaseEvents* events);

  std::optional<Contact> contact_;
  std::size_t strands_;
  std::vector<Chain> chains_;  ///< empty without ChainDynamics::body
  ChainDynamics dynamics_;
  ChainParams params_;
  int lanes_;
  bool own_damping_;
  std::size_t room_ = 0;  ///< number of strands in the tables whose names begin with some_
  cl::Program program_, key_program_;
  cl::Kernel frame_, write_keys_;
  cl::Buffer<float> constants_, states_;
  cl::Buffer<float> some_constants_, some_states_;  ///< one slice per work-item (chain.cl)
  cl::Buffer<float> field_, body_, some_body_;      ///< empty without ChainDynamics::body
  std::optional<MovingSkin> skin_;
  cl::Buffer<ChainMoment> moments_, present_;
  long steps_ = 0;
  long known_from_ = 0,
       known_to_ = 0;  // the device has gravity, wind and motion of the steps known_from_ to known_to_ - 1
};

}  // namespace pelage::strands
