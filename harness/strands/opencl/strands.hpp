// The pipeline that draws fur as single strands on an OpenCL device. Every frame has the phases simulate,
// keys, sort, bin and raster.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/cl/frame_timing.hpp"
#include "harness/picture/picture.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "harness/strands/opencl/drawer.hpp"
#include "harness/strands/scene/strand_input.hpp"

namespace pelage::strands {

/// Returns the way to draw that has the name `name` (harness/cl/program.hpp), or the device's default
/// if `name` is empty. Throws InputError for other names.
Drawing drawing_named(const std::string& name);

/// A scene on an OpenCL device. frame() advances the chains by scene.dynamics.substeps substeps and draws one
/// picture.
class Strands {
 public:
  /// Throws InputError or DeviceError.
  Strands(const cl::Device& device, std::shared_ptr<const StrandInput> input,
          const DrawerOptions& options = {});

  cl::FrameTiming frame();  ///< simulates, draws and times one frame
  /// Draws and times one picture of the present chains, without a simulation. The time does not contain the
  /// conversion of the chains to key strands.
  cl::FrameTiming still();
  /// Changes the camera, the light, the background and the look of the following pictures, and builds
  /// nothing. `input` differs from the present input only as with_view() permits. Returns false, and changes
  /// nothing, if the programs would have to be built again (Drawer::can_show()).
  bool set_view(std::shared_ptr<const StrandInput> input);
  void advance(int frames);  ///< simulates `frames` frames without drawing
  /// Copies the picture of the last frame to the host.
  Picture read() const { return drawer_.read(queue_); }
  int frames_simulated() const { return frames_; }  ///< number of frames since the fur was at rest
  /// Returns the states of the chains, in the order of the key strands.
  std::vector<ChainState> states() const { return chains_.states(queue_); }
  /// Simulates one substep. Returns its index, which is the number of substeps before it.
  long substep();
  /// Computes the skin of the next frame of a mesh that deforms and passes it to the device. It is input of
  /// the simulation, as the pose of an animated character is, so frame() does not time it. frame() and
  /// advance() call this function if the caller has not; a caller that measures the CPU time of frame() calls
  /// it before.
  void follow_skin();
  /// The skin at the roots at the beginning and at the end of the last frame if the mesh deforms. The last
  /// substep() went from the beginning to the middle.
  std::optional<std::pair<SkinFrame, SkinFrame>> skin_frames() const;
  /// The skin in the last picture, or null.
  std::shared_ptr<const SkinSurface> surface() const { return skin_ ? skin_->surface() : input_->skin; }
  /// Returns the key strands of the last picture.
  std::vector<KeyStrand> keys();
  /// Returns all strands as the kernels computed them for the last picture. The function overwrites the list
  /// that order() returns until the next frame.
  std::vector<DrawnStrand> curves() { return drawer_.curves(queue_); }
  /// Returns the list of the strands that the last picture shows, from front to back.
  std::vector<Entry> order() const { return drawer_.order(queue_); }
  std::vector<const cl::Program*> programs() const;

 private:
  void use_forces();                   ///< sets the colliders, and the forces if they have keyframes
  void move(cl::PhaseEvents* events);  ///< simulates a frame

  cl::Queue queue_;
  std::shared_ptr<const StrandInput> input_;
  Chains chains_;
  Drawer drawer_;
  std::optional<SkinFrames> skin_;  ///< empty if the mesh does not deform
  SkinFrame before_;                ///< the skin at the beginning of the last frame
  bool followed_ = false;           ///< the skin of the next frame is on the device
  int frames_ = 0;
};

}  // namespace pelage::strands
