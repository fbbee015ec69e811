// Prefix sums and stable radix sorts on a device. The kernels are in the files prefix_sum.clh, radix_sort.cl
// and pair_sort.cl in kernels/common/.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// Computes exclusive prefix sums in place, and sorts pairs by their keys (a stable sort). Lengths are below
/// 2^31. A sum of 2^31 or more becomes 2^31 - 1. A call enqueues several kernel launches. If `events` is not
/// null, the call appends the events of these launches to it, in the phase `phase` of the constructor.
class RadixSort {
 public:
  explicit RadixSort(const Device& device, const char* phase = "bin");
  static ProgramText program_text();
  /// Replaces value[i] by the sum of the values before it. If `read_sum` is true, the function waits for the
  /// kernels to end and returns the sum of all `count` values, or 2^31 - 1 if the sum is larger. If
  /// `read_sum` is false, the function does not wait and returns 0.
  std::int32_t scan(const Queue& queue, const Buffer<std::int32_t>& value, std::size_t count,
                    PhaseEvents* events, bool read_sum);
  /// Sorts `count` pairs by their keys, which must all be in 0 .. 2^bits - 1. Pairs with equal keys keep
  /// their order. The call may swap `key` and `value` with internal buffers of this object.
  void sort(const Queue& queue, Buffer<std::int32_t>& key, Buffer<std::int32_t>& value, std::size_t count,
            int bits, PhaseEvents* events);
  const Program& program() const { return program_; }

 private:
  const char* phase_;
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

struct Pair {
  std::uint32_t key = 0, value = 0;
  bool operator==(const Pair&) const = default;
};

/// Sorts pairs by their keys. Pairs with equal keys keep their order. The pairs are divided into runs; a
/// work-item processes one run. Equal pairs give equal bits for every number of runs.
class PairSort {
 public:
  /// `runs`: number of runs, 1 to 65536; 0: the default of the device. Throws InputError if `runs` is out of
  /// range.
  explicit PairSort(const Device& device, int runs = 0);
  /// The programs that PairSort(device, runs) builds.
  static std::vector<ProgramText> program_texts(const Device& device, int runs);
  int runs() const { return runs_; }

  /// Returns the capacity of a run for at most `count` pairs: run r begins at index r * capacity(count).
  std::size_t capacity(std::size_t count) const;

  /// Sorts the pairs in `pair` by the lowest `bits` bits of their keys; all higher bits must be 0. Run r
  /// consists of live[r] pairs, which begin at index r * capacity. The call enqueues kernels and does not
  /// wait. The sorted pairs begin at index 0 of `pair`, without gaps, and total() receives their number. The
  /// call may swap `pair` with an internal buffer of this object. If `events` is not null, the events of the
  /// launches are appended to it, in the phase sort. `pair` has fewer than 2^31 elements.
  void sort(const Queue& queue, Buffer<Pair>& pair, const Buffer<std::int32_t>& live, std::size_t capacity,
            int bits, PhaseEvents* events = nullptr);

  /// Number of the sorted pairs, on the device.
  const Buffer<std::int32_t>& total() const { return total_; }
  std::vector<const Program*> programs() const;

 private:
  static constexpr const char* phase_ = "sort";
  int runs_, bits_;
  std::optional<RadixSort> scan_;  ///< empty for few runs
  Program program_;
  Kernel sum_, count_, move_;
  Buffer<std::int32_t> counts_, total_;
  Buffer<Pair> other_;
};

}  // namespace pelage::cl
