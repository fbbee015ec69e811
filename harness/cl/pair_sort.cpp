#include "harness/cl/pair_sort.hpp"

#include <fmt/format.h>

#include <utility>

#include "harness/error.hpp"

namespace pelage::cl {
namespace {

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
  if (runs_ > few_runs) scan_.emplace(device);
}

std::vector<const Program*> PairSort::programs() const {
  std::vector<const Program*> all{&program_};
  if (scan_) all.push_back(&scan_->program());
  return all;
}

std::size_t PairSort::capacity(std::size_t count) const {
  return (count + std::size_t(runs_) - 1) / std::size_t(runs_);
}

void PairSort::sort(const Queue& queue, Buffer<Pair>& pair, const Buffer<std::int32_t>& live,
                    std::size_t capacity, int bits, std::vector<Event>* events) {
  const auto keep = [&](Event event) {
    if (events) events->push_back(std::move(event));
  };
  if (other_.size() < pair.size()) other_ = Buffer<Pair>(queue.device(), pair.size());
  const auto runs = std::size_t(runs_);
  sum_.with(std::int32_t(runs_), live, total_);
  keep(sum_.enqueue(queue, 1, 1));
  int gaps = int(capacity);
  for (int shift = 0; shift < bits; shift += bits_) {
    count_.with(std::int32_t(runs_), gaps, shift, live, total_, pair, counts_);
    keep(count_.enqueue(queue, runs));
    if (scan_) scan_->scan(queue, counts_, counts_.size(), events, false);
    move_.with(std::int32_t(runs_), gaps, shift, std::int32_t(runs_ > few_runs), live, total_, counts_, pair,
               other_);
    keep(move_.enqueue(queue, runs));
    std::swap(pair, other_);
    gaps = 0;
  }
}

}  // namespace pelage::cl
