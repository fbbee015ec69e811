// Bins of the mapping "group", made on the device by prefix sums and a stable radix sort.
#pragma once
#include <string>
#include <vector>

#include "harness/shells/opencl/stages.hpp"

namespace pelage::shells {

/// Pixels a side of a tile of the mapping "group", and its work-items.
constexpr int group_tile = 8;
constexpr std::size_t group_items = std::size_t(group_tile) * group_tile;

/// In-place exclusive prefix sums, and a stable sort of pairs by their key. Sums and lengths stay below 2^31.
class GroupSort {
 public:
  explicit GroupSort(const cl::Device& device);
  /// value[i] becomes the sum of those before it. Returns the sum of all, 2^31 - 1 where it is that or more.
  std::int32_t scan(const cl::Queue& queue, const cl::Buffer<std::int32_t>& value, std::size_t count,
                    PhaseEvents* events, bool read_sum);
  /// Sorts `count` pairs by their keys, all below 2^bits; pairs of the same key keep their order.
  void sort(const cl::Queue& queue, cl::Buffer<std::int32_t>& key, cl::Buffer<std::int32_t>& value,
            std::size_t count, int bits, PhaseEvents* events);
  double build_ms() const { return program_.build_ms(); }

 private:
  cl::Program program_;
  cl::Kernel blocks_, add_, count_, move_;
  std::vector<cl::Buffer<std::int32_t>> sums_;  // of blocks, of blocks of blocks, ...
  cl::Buffer<std::int32_t> digits_, other_key_, other_value_;
};

/// The lists of triangles per tile and group of layers, in the mesh's order: a work-item per triangle counts
/// and writes its entries, and a sort brings the lists together.
class GroupBins {
 public:
  GroupBins(const cl::Device& device, const RasterParams& params, const std::string& options);
  /// corner, box: as kernels/rasterize/geometry/geometry.cl leaves them. start: one more than there are
  /// lists. list: grows as it must, so that no triangle is dropped. Waits for its length; throws DeviceError
  /// where that is 2^31 or more.
  void make(const cl::Queue& queue, const RasterParams& params, const cl::Buffer<std::int32_t>& corner,
            const cl::Buffer<float>& box, const cl::Buffer<std::int32_t>& start,
            cl::Buffer<std::int32_t>& list, PhaseEvents* events);
  double build_ms() const { return program_.build_ms() + sort_.build_ms(); }

 private:
  cl::Program program_;
  cl::Kernel count_, emit_, starts_;
  GroupSort sort_;
  cl::Buffer<std::int32_t> offset_, key_;
};

}  // namespace pelage::shells
