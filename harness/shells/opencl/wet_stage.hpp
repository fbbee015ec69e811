// The stage that computes the wetness mask.
#pragma once
#include <optional>

#include "harness/cl/program.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/build_options.hpp"

namespace pelage::shells {

/// Computes the wetness mask (docs/frame.md, section 2). If the scene has no droplets, the mask is zero
/// everywhere, and no kernel is built.
class WetStage {
 public:
  WetStage(const cl::Queue& queue, const FrameInput& input, const Tuning& tuning = {});
  cl::Event run(const cl::Queue& queue);  ///< computes the mask; the constructor calls run(), too
  const cl::Buffer<float>& mask() const { return mask_; }                         ///< 4 floats per texel
  const cl::Program* program() const { return program_ ? &*program_ : nullptr; }  ///< null without droplets
  double mask_ms() const { return mask_ms_; }  ///< wall time of the mask's kernel in ms; 0 without droplets

 private:
  int size_, bucket_;          // sides, in texels, of the mask and of a bucket (a square block of texels)
  bool consistent_, overlap_;  ///< clump.cells = "consistent", wetness.blend = "overlap"
  std::optional<cl::Program> program_;
  std::optional<cl::Kernel> kernel_;
  cl::Buffer<float> droplets_, surface_, mask_;
  cl::Buffer<std::int32_t> row_, drop_;
  double mask_ms_ = 0;
};

}  // namespace pelage::shells
