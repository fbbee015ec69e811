// Computes prefix sums and a stable radix sort on a device. The kernels are in the files prefix_sum.clh and
// radix_sort.cl in kernels/common/.
#pragma once
#include <cstdint>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// Computes exclusive prefix sums in place, and sorts pairs by their keys (a stable sort). Lengths are below
/// 2^31. A sum of 2^31 or more becomes 2^31 - 1. A call enqueues several kernel launches. If `events` is not
/// null, the call appends the events of these launches to it.
class RadixSort {
 public:
  explicit RadixSort(const Device& device);
  static ProgramText program_text();
  /// Replaces value[i] by the sum of the values before it. If `read_sum` is true, the function waits for the
  /// kernels to end and returns the sum of all `count` values, or 2^31 - 1 if the sum is larger. If
  /// `read_sum` is false, the function does not wait and returns 0.
  std::int32_t scan(const Queue& queue, const Buffer<std::int32_t>& value, std::size_t count,
                    std::vector<Event>* events, bool read_sum);
  /// Sorts `count` pairs by their keys, which must all be in 0 .. 2^bits - 1. Pairs with equal keys keep
  /// their order. The call may swap `key` and `value` with internal buffers of this object.
  void sort(const Queue& queue, Buffer<std::int32_t>& key, Buffer<std::int32_t>& value, std::size_t count,
            int bits, std::vector<Event>* events);
  const Program& program() const { return program_; }

 private:
  Program program_;
  Kernel blocks_, add_, count_, move_;
  // scan() divides the values into blocks. sums_[0] contains the sum of each block. sums_[i] contains the sum
  // of each block of sums_[i - 1].
  std::vector<Buffer<std::int32_t>> sums_;
  Buffer<std::int32_t> digits_, other_key_, other_value_;
};

/// Replaces `buffer` if it has fewer than `count` values. The new buffer has room for 1.25 * `count` values,
/// so that a later call with a slightly larger `count` needs no new buffer. The contents are lost.
void grow(const Queue& queue, Buffer<std::int32_t>& buffer, std::size_t count);

}  // namespace pelage::cl
