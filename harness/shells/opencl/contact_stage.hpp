// The colliders of a scene (docs/shells.md, section 9) on a device.
#pragma once
#include "harness/cl/buffer.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage::shells {

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

}  // namespace pelage::shells
