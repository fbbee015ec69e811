// The stage that simulates the strands of S.
#pragma once
#include <optional>

#include "harness/cl/buffer.hpp"
#include "harness/cl/program.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/geometry.hpp"
#include "harness/shells/opencl/program_texts.hpp"
#include "kernels/simulate/params.h"

namespace pelage::shells {

/// The colliders of a scene (docs/shells.md, section 9) on a device.
class ContactStage {
 public:
  ContactStage(const cl::Queue& queue, const FrameInput& input);
  /// Writes the colliders of frame number `frame`, counted from 0: their rows at the end of each substep.
  void set_frame(const cl::Queue& queue, int frame);
  /// Returns the colliders in the form that kernels/common/contact.clh describes.
  const cl::Buffer<float>& table() const { return table_; }
  const cl::Buffer<float>& field() const { return field_; }  ///< DistanceField::distance, or one 0
  int last() const { return dynamics_.substeps - 1; }        ///< number of the picture's time in the table

 private:
  std::vector<float> values(int frame) const;

  ContactScene scene_;
  DynamicsScene dynamics_;
  std::vector<float> header_;
  cl::Buffer<float> table_, field_;
};

/// Simulates all strands. Eq. 2 of S moves the tips, and Eq. 3 limits their positions.
class SimulateStage {
 public:
  SimulateStage(const cl::Queue& queue, const FrameInput& input, const Geometry& geometry, int lanes,
                const Tuning& tuning = {});
  void frame(const cl::Queue& queue, int number, cl::PhaseEvents* events);
  /// Returns the colliders of the last frame; null if the scene has none.
  const ContactStage* contact() const { return contact_ ? &*contact_ : nullptr; }
  /// Returns the tips and velocities of the strands: STATE_COLUMNS columns of stride() floats.
  const cl::Buffer<float>& state() const { return state_; }
  int stride() const { return params_.stride; }
  const cl::Program& program() const { return program_; }

 private:
  cl::Program program_;
  cl::Kernel step_;
  SimulateParams params_;
  DynamicsScene dynamics_;
  int lanes_;
  std::size_t group_;  // number of work-items per work-group; 0: cl::usual_group()
  cl::Buffer<float> gusts_, constants_, state_;
  std::optional<ContactStage> contact_;
};

}  // namespace pelage::shells
