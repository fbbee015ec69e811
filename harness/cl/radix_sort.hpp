// Prefix sums and a stable radix sort on a device: kernels/common/prefix_sum.clh and radix_sort.cl.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// Exclusive prefix sums in place, and a stable sort of pairs by their keys. Lengths and sums are below 2^31.
/// Every call enqueues its launches and appends their events to `events` if it is not null.
class RadixSort {
 public:
  explicit RadixSort(const Device& device);
  /// Replaces value[i] by the sum of the values before it. With `read_sum`, waits and returns the sum of all
  /// `count` values, or 2^31 - 1 if the sum is that or more; otherwise returns 0.
  std::int32_t scan(const Queue& queue, const Buffer<std::int32_t>& value, std::size_t count,
                    std::vector<Event>* events, bool read_sum);
  /// Sorts `count` pairs by their keys, all in 0 .. 2^bits - 1. Pairs with equal keys keep their order. The
  /// call may swap both buffers with buffers of this object.
  void sort(const Queue& queue, Buffer<std::int32_t>& key, Buffer<std::int32_t>& value, std::size_t count,
            int bits, std::vector<Event>* events);
  const Program& program() const { return program_; }

 private:
  Program program_;
  Kernel blocks_, add_, count_, move_;
  std::vector<Buffer<std::int32_t>> sums_;  // of blocks, of blocks of blocks, ...
  Buffer<std::int32_t> digits_, other_key_, other_value_;
};

/// If `buffer` has fewer than `count` values, replaces it by a buffer of a quarter more than `count`, because
/// the next frame's lists have about the same length. The contents are lost.
void grow(const Queue& queue, Buffer<std::int32_t>& buffer, std::size_t count);

}  // namespace pelage::cl
