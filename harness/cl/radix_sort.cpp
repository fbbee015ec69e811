#include "harness/cl/radix_sort.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "harness/error.hpp"

namespace pelage::cl {
namespace {

// Constants of the kernels in kernels/common/prefix_sum.clh and kernels/common/radix_sort.cl. The constructor
// passes them as build options.
constexpr std::size_t scan_items = 64, scan_block = scan_items * 16;
constexpr std::size_t sort_run = 32;
constexpr int sort_bits = 4;

std::size_t ceil_div(std::size_t a, std::size_t b) {
  return (a + b - 1) / b;
}

// On CPUs, a work-item has a core and its cache for itself, so few runs with large digits need the fewest
// passes over the pairs. On GPUs, thousands of work-items must be busy, and their counters share the small
// local memory.
struct Layout {
  int runs, items, bits;
};
constexpr Layout on_cpu{16, 1, 8}, on_gpu{16384, 64, 4};
constexpr int most_runs = 65536;

// For at most this number of runs, each work-item of pair_move adds the counts of all runs itself. This saves
// the launches of the prefix sums.
constexpr int few_runs = 32;

int checked(int runs, const Layout& layout) {
  if (runs < 0 || runs > most_runs)
    throw InputError(fmt::format("sort: {} runs; give 1 to {}, or 0 for the default", runs, most_runs));
  return runs > 0 ? runs : layout.runs;
}

const Layout& layout_of(const Device& device) {
  return device.info().cpu ? on_cpu : on_gpu;
}

}  // namespace

void grow(const Queue& queue, Buffer<std::int32_t>& buffer, std::size_t count) {
  if (count > buffer.size()) buffer = Buffer<std::int32_t>(queue.device(), count + count / 4);
}

ProgramText RadixSort::program_text() {
  return {"common/radix_sort.cl",
          fmt::format("-D LANES=1 -D SCAN_ITEMS={} -D SCAN_EACH={} -D SORT_BITS={} -D SORT_RUN={}",
                      scan_items, scan_block / scan_items, sort_bits, sort_run)};
}

RadixSort::RadixSort(const Device& device, const char* phase)
    : phase_(phase),
      program_(device, program_text()),
      blocks_(program_, "scan_blocks"),
      add_(program_, "scan_add"),
      count_(program_, "sort_count"),
      move_(program_, "sort_move") {}

std::int32_t RadixSort::scan(const Queue& queue, const Buffer<std::int32_t>& value, std::size_t count,
                             PhaseEvents* events, bool read_sum) {
  // Level 0 contains the values. The first loop computes the prefix sums within each block of a level, and
  // stores the sums of the blocks as the next level. It ends at a level that has one block. The second loop
  // visits the levels in reverse order, down to level 0. In each level it adds to every entry the sum of all
  // blocks before the entry's block.
  std::vector<std::size_t> length{count};
  std::size_t level = 0;
  do {
    const std::size_t blocks = std::max<std::size_t>(ceil_div(length[level], scan_block), 1);
    if (sums_.size() == level) sums_.emplace_back();
    grow(queue, sums_[level], blocks);
    blocks_.with(std::int32_t(length[level]), level == 0 ? value : sums_[level - 1], sums_[level]);
    keep(events, phase_, blocks_.enqueue(queue, blocks * scan_items));
    length.push_back(blocks);
    ++level;
  } while (length[level] > 1);
  for (std::size_t i = level - 1; i-- > 0;) {
    add_.with(std::int32_t(length[i]), sums_[i], i == 0 ? value : sums_[i - 1]);
    keep(events, phase_, add_.enqueue_loop(queue, length[i]));
  }
  std::array<std::int32_t, 1> sum{};
  if (read_sum) sums_[level - 1].read(queue, sum);
  return sum[0];
}

void RadixSort::sort(const Queue& queue, Buffer<std::int32_t>& key, Buffer<std::int32_t>& value,
                     std::size_t count, int bits, PhaseEvents* events) {
  if (count == 0) return;
  const std::size_t runs = ceil_div(count, sort_run), digits = runs << sort_bits;
  grow(queue, digits_, digits);
  grow(queue, other_key_, count);
  grow(queue, other_value_, count);
  for (int shift = 0; shift < bits; shift += sort_bits) {
    count_.with(std::int32_t(count), shift, key, digits_);
    keep(events, phase_, count_.enqueue(queue, runs));
    scan(queue, digits_, digits, events, false);
    move_.with(std::int32_t(count), shift, digits_, key, value, other_key_, other_value_);
    keep(events, phase_, move_.enqueue(queue, runs));
    std::swap(key, other_key_);
    std::swap(value, other_value_);
  }
}

std::vector<ProgramText> PairSort::program_texts(const Device& device, int runs) {
  const Layout& layout = layout_of(device);
  std::vector<ProgramText> texts{
      {"common/pair_sort.cl",
       fmt::format("-D LANES=1 -D SORT_BITS={} -D SORT_ITEMS={}", layout.bits, layout.items)}};
  if (checked(runs, layout) > few_runs) texts.push_back(RadixSort::program_text());
  return texts;
}

PairSort::PairSort(const Device& device, int runs)
    : runs_(checked(runs, layout_of(device))),
      bits_(layout_of(device).bits),
      program_(device, program_texts(device, runs).front()),
      sum_(program_, "pair_total"),
      count_(program_, "pair_count"),
      move_(program_, "pair_move"),
      counts_(device, std::size_t(runs_) << bits_),
      total_(device, 1) {
  if (runs_ > few_runs) scan_.emplace(device, phase_);
}

std::vector<const Program*> PairSort::programs() const {
  std::vector<const Program*> all{&program_};
  if (scan_) all.push_back(&scan_->program());
  return all;
}

std::size_t PairSort::capacity(std::size_t count) const {
  return ceil_div(count, std::size_t(runs_));
}

void PairSort::sort(const Queue& queue, Buffer<Pair>& pair, const Buffer<std::int32_t>& live,
                    std::size_t capacity, int bits, PhaseEvents* events) {
  if (other_.size() < pair.size()) other_ = Buffer<Pair>(queue.device(), pair.size());
  const auto runs = std::size_t(runs_);
  sum_.with(std::int32_t(runs_), live, total_);
  keep(events, phase_, sum_.enqueue(queue, 1, 1));
  int gaps = int(capacity);
  for (int shift = 0; shift < bits; shift += bits_) {
    count_.with(std::int32_t(runs_), gaps, shift, live, total_, pair, counts_);
    keep(events, phase_, count_.enqueue(queue, runs));
    if (scan_) scan_->scan(queue, counts_, counts_.size(), events, false);
    move_.with(std::int32_t(runs_), gaps, shift, std::int32_t(runs_ > few_runs), live, total_, counts_, pair,
               other_);
    keep(events, phase_, move_.enqueue(queue, runs));
    std::swap(pair, other_);
    gaps = 0;
  }
}

}  // namespace pelage::cl
