// The colliders of a scene (docs/colliders.md) on a device.
#pragma once
#include <vector>

#include "harness/cl/buffer.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Returns the build option of the kernels that include common/contact.clh: "" without colliders.
std::string contact_options(const ContactScene& scene);

class ContactStage {
 public:
  /// `fields`: FrameInput::contact_fields.
  ContactStage(const cl::Queue& queue, const Scene& scene, const ContactFields& fields);
  /// Writes the colliders of frame number `frame`, counted from 0: their rows at the end of each substep.
  void set_frame(const cl::Queue& queue, int frame);
  /// Returns the colliders in the form that kernels/common/contact.clh describes.
  const cl::Buffer<float>& table() const { return table_; }
  const cl::Buffer<float>& field() const { return field_; }
  int last() const { return dynamics_.substeps - 1; }  ///< number of the picture's time in the table

 private:
  std::vector<float> values(int frame) const;
  double time_of(int frame, int substep) const;
  /// Returns the number of the first file whose field a frame needs (ContactMoment::file).
  int first_file(int frame) const;

  ContactScene scene_;
  DynamicsScene dynamics_;
  ContactFields fields_;
  std::vector<float> header_;
  cl::Buffer<float> table_, field_;
  int first_ = 0;  ///< number of the first file in field_
};

}  // namespace pelage
