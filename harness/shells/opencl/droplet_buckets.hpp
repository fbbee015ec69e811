// Lists of droplets for the kernel that computes the wetness mask. A bucket is a square block of the mask's
// texels.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::shells {

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

}  // namespace pelage::shells
