// Lists of the droplets that touch each texel of the wetness mask, for water that changes over time.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/cl/program.hpp"
#include "kernels/wet/params.h"

namespace pelage::shells {

/// The lists depend only on the droplets' discs, so they are made once. In a frame, the kernel needs the
/// present wetness of the droplets and the order of blending (kernels/wet/texel_lists.clh).
class TexelLists {
 public:
  /// `program` is wet/wet.cl. `droplets` has one row per droplet, in the order of FrameInput::droplets. `row`
  /// and `drop` are the lists of all buckets, and `surface` the surface points of the texels.
  TexelLists(const cl::Queue& queue, const cl::Program& program, const WetParams& params,
             const cl::Buffer<float>& droplets, const cl::Buffer<std::int32_t>& row,
             const cl::Buffer<std::int32_t>& drop, const cl::Buffer<float>& surface);
  /// False if a list has more than `most` entries, or if all lists have more than most_entries. run() would
  /// then take long, and must not be called.
  bool short_enough() const { return short_enough_; }
  static constexpr int most = 64;
  static constexpr std::int64_t most_entries = std::int64_t(1) << 27;
  /// Uploads the present wetness of each droplet. `order` contains the indices of the droplets that are
  /// blended, in the order of blending.
  void upload(const cl::Queue& queue, const std::vector<float>& rho, const std::vector<std::uint32_t>& order);
  /// Computes the mask.
  cl::Event run(const cl::Queue& queue, const WetParams& params, const cl::Buffer<float>& droplets,
                cl::Buffer<float>& mask);

 private:
  bool short_enough_ = false;
  cl::Kernel kernel_;
  cl::Buffer<std::int32_t> start_, list_, rank_;
  cl::Buffer<float> rho_;
};

}  // namespace pelage::shells
