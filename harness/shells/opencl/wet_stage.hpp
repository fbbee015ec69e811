// The stage that computes the wetness mask.
#pragma once
#include <optional>

#include "harness/cl/program.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/droplet_buckets.hpp"
#include "harness/shells/opencl/program_texts.hpp"

namespace pelage::shells {

/// Computes the wetness mask (docs/shells.md, section 2). If the scene has no droplets, the mask is zero
/// everywhere, and no kernel is built. If the water changes over time (docs/shells.md, section 10), the
/// constructor computes the mask of the first picture, at the time dynamics.time.
class WetStage {
 public:
  WetStage(const cl::Queue& queue, const FrameInput& input, const Tuning& tuning = {});
  /// Uploads the droplets that are wet in the picture after `frames` frames. Call run() afterwards. Waits
  /// until the commands in the queue have finished.
  void upload_droplets(const cl::Queue& queue, const FrameInput& input, int frames);
  /// Computes the mask. The constructor calls run(), too, if there are droplets.
  cl::Event run(const cl::Queue& queue);
  bool changes() const { return changes_; }                ///< true: the water changes over time
  const cl::Buffer<float>& mask() const { return mask_; }  ///< 4 floats per texel
  const cl::Program* program() const { return program_ ? &*program_ : nullptr; }  ///< null without droplets

 private:
  void build(const cl::Queue& queue);
  WetParams params() const;
  /// Makes the lists of the texels, unless they are long.
  void make_lists(const cl::Queue& queue, const FrameInput& input);
  /// Uploads the droplets with the indices `order`, in this order, and the lists of the buckets.
  void upload_rows(const cl::Queue& queue, const FrameInput& input, const std::vector<float>& rho,
                   const std::vector<std::uint32_t>& order);

  int size_;                   // side of the mask, texels
  bool consistent_, overlap_;  ///< clump.cells = "consistent", wetness.blend = "overlap"
  bool changes_;
  int bucket_;  // side of a bucket (a square block of texels), texels
  DropletBuckets buckets_;
  std::optional<cl::Program> program_;
  std::optional<cl::Kernel> kernel_;
  cl::Buffer<float> droplets_, surface_, mask_;
  cl::Buffer<std::int32_t> row_, drop_;
  std::optional<TexelLists> lists_;  ///< used if the water changes and no list is long
};

}  // namespace pelage::shells
