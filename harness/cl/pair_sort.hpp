// A stable radix sort of pairs on a device (kernels/common/pair_sort.cl).
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/cl/radix_sort.hpp"

namespace pelage::cl {

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
  /// launches are appended to it. `pair` has fewer than 2^31 elements.
  void sort(const Queue& queue, Buffer<Pair>& pair, const Buffer<std::int32_t>& live, std::size_t capacity,
            int bits, std::vector<Event>* events = nullptr);

  /// Number of the sorted pairs, on the device.
  const Buffer<std::int32_t>& total() const { return total_; }
  std::vector<const Program*> programs() const;

 private:
  int runs_, bits_;
  std::optional<RadixSort> scan_;  ///< empty for few runs
  Program program_;
  Kernel sum_, count_, move_;
  Buffer<std::int32_t> counts_, total_;
  Buffer<Pair> other_;
};

}  // namespace pelage::cl
