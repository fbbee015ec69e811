// The stage that computes the wetness mask.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opencl/program_texts.hpp"
#include "kernels/wet/params.h"

namespace pelage::shells {

// A bucket is a square block of the mask's texels.

/// The lists of all buckets. List b holds drop[row[b]] to drop[row[b + 1] - 1].
struct BucketLists {
  std::vector<std::int32_t> row, drop;
};

/// Finds the buckets that each droplet may touch. They do not change over time, because a droplet keeps its
/// disc.
class DropletBuckets {
 public:
  /// `texels` is the number of texels per side of a bucket. With `near`, a bucket is left out if the surface
  /// points of all its texels are out of the droplet's reach. This takes longer, and makes the lists shorter:
  /// most repetitions across UV seams reach no texel of most of their buckets.
  DropletBuckets(const FrameInput& input, int texels, bool near);
  /// Returns the lists of the droplets with the given indices. An entry of a list is a position in `order`;
  /// entries ascend.
  BucketLists lists(const std::vector<std::uint32_t>& order) const;
  /// Returns the number of entries of the lists of all droplets.
  std::size_t entries() const { return bucket_.size(); }
  std::size_t buckets() const { return count_; }

 private:
  std::size_t count_;
  std::vector<std::uint32_t> row_,
      bucket_;  ///< droplet i touches bucket_[row_[i]] to bucket_[row_[i + 1] - 1]
};

/// Lists of the droplets that touch each texel of the wetness mask, for water that changes over time. The
/// lists depend only on the droplets' discs, so they are made once. In a frame, the kernel needs the
/// present wetness of the droplets and the order of blending (kernels/wet/texel_lists.clh).
class TexelLists {
 public:
  /// `program` is wet/wet.cl. `droplets` has one row per droplet, in the order of FrameInput::droplets. `row`
  /// and `drop` are the lists of all buckets, and `surface` the surface points of the texels.
  TexelLists(const cl::Queue& queue, const cl::Program& program, const WetParams& params,
             const cl::Buffer<float>& droplets, const cl::Buffer<std::int32_t>& row,
             const cl::Buffer<std::int32_t>& drop, const cl::Buffer<glm::vec3>& surface);
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
                cl::Buffer<glm::vec4>& mask);

 private:
  bool short_enough_ = false;
  cl::Kernel kernel_;
  cl::Buffer<std::int32_t> start_, list_, rank_;
  cl::Buffer<float> rho_;
};

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
  bool changes() const { return changes_; }                    ///< true: the water changes over time
  const cl::Buffer<glm::vec4>& mask() const { return mask_; }  ///< one value per texel
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
  cl::Buffer<float> droplets_;
  cl::Buffer<glm::vec3> surface_;
  cl::Buffer<glm::vec4> mask_;
  cl::Buffer<std::int32_t> row_, drop_;
  std::optional<TexelLists> lists_;  ///< used if the water changes and no list is long
};

}  // namespace pelage::shells
