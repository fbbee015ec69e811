// pelage-bench-sort: compares the device's sort of pairs (harness/cl/pair_sort.hpp) with std::stable_sort and
// with a serial radix sort. The three sort the same pairs in turns, so that a change of the machine's speed
// affects all of them. The program prints the medians of wall time and CPU time, and the medians of the
// ratios within a turn. It fails if a result differs from that of std::stable_sort.
//
// Usage: pelage-bench-sort [COUNT [ROUNDS]]. PoCL uses one thread if the environment has
// POCL_MAX_PTHREAD_COUNT=1.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <random>

#include "bench/program.hpp"
#include "bench/timing.hpp"
#include "harness/cl/pair_sort.hpp"

namespace {

using namespace pelage;
using bench::median;
using bench::Time;
using bench::timed;
using cl::Pair;

/// A least-significant-digit radix sort with three digits of 11, 11 and 10 bits, as one would write it for
/// one thread: one pass counts all three digits.
void radix_sort(std::vector<Pair>& pairs, std::vector<Pair>& other) {
  static constexpr std::array<int, 3> shift{0, 11, 22};
  static constexpr std::uint32_t mask = 2047;
  std::array<std::array<std::uint32_t, 2048>, 3> next{};
  for (const Pair& pair : pairs)
    for (std::size_t k = 0; k < 3; ++k) ++next[k][pair.key >> shift[k] & mask];
  for (auto& digits : next) {
    std::uint32_t sum = 0;
    for (std::uint32_t& digit : digits) sum += std::exchange(digit, sum);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Pair& pair : pairs) other[next[k][pair.key >> shift[k] & mask]++] = pair;
    pairs.swap(other);
  }
}

int run(std::size_t count, int rounds) {
  const cl::Device device = cl::choose_device("");
  const cl::Queue queue(device);
  cl::PairSort sort(device);
  std::mt19937 random(1);
  std::vector<Pair> input(count);
  for (std::uint32_t i = 0; i < count; ++i) input[i] = {std::uint32_t(random()), i};
  const std::size_t capacity = sort.capacity(count);
  std::vector<std::int32_t> lengths;
  for (std::size_t r = 0; r < std::size_t(sort.runs()); ++r)
    lengths.push_back(std::int32_t(std::min(capacity, count - std::min(count, r * capacity))));
  const cl::Buffer<std::int32_t> live(queue, lengths);
  cl::Buffer<Pair> buffer(device, capacity * std::size_t(sort.runs()));

  struct Way {
    const char* name;
    std::vector<double> wall, cpu, wall_ratio, cpu_ratio;
  };
  std::array<Way, 3> ways{Way{"device", {}, {}, {}, {}}, Way{"std::stable_sort", {}, {}, {}, {}},
                          Way{"serial radix sort", {}, {}, {}, {}}};
  std::vector<Pair> result(count), other(count);
  for (int round = -1; round < rounds;
       ++round) {  // round -1 is not timed: it touches all memory for the first time
    std::array<Time, 3> time{};
    buffer.write(queue, input);
    time[0] = timed([&] {
      sort.sort(queue, buffer, live, capacity, 32);
      queue.finish();
    });
    std::vector<Pair> standard = input;
    time[1] = timed([&] {
      std::stable_sort(standard.begin(), standard.end(),
                       [](const Pair& a, const Pair& b) { return a.key < b.key; });
    });
    buffer.read(queue, result);
    if (result != standard)
      throw std::runtime_error("the device's order differs from that of std::stable_sort");
    std::copy(input.begin(), input.end(), result.begin());
    time[2] = timed([&] { radix_sort(result, other); });
    if (result != standard) throw std::runtime_error("the serial radix sort differs from std::stable_sort");
    for (std::size_t i = 0; round >= 0 && i < ways.size(); ++i) {
      ways[i].wall.push_back(time[i].wall_ms);
      ways[i].cpu.push_back(time[i].cpu_ms);
      ways[i].wall_ratio.push_back(time[i].wall_ms / time[0].wall_ms);
      ways[i].cpu_ratio.push_back(time[i].cpu_ms / time[0].cpu_ms);
    }
  }
  fmt::print("{} pairs, {} rounds in turns, {}\n", count, rounds, device.info().name);
  fmt::print("{:<18} {:>9} {:>9} {:>12} {:>12}\n", "", "wall, ms", "CPU, ms", "wall : device",
             "CPU : device");
  for (const Way& way : ways)
    fmt::print("{:<18} {:>9.2f} {:>9.2f} {:>12.2f} {:>12.2f}\n", way.name, median(way.wall), median(way.cpu),
               median(way.wall_ratio), median(way.cpu_ratio));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::exit_code("pelage-bench-sort", argc, argv, [](bench::Arguments a) {
    const long count = std::atol(a.at(1, "1000000").c_str()), rounds = std::atol(a.at(2, "15").c_str());
    if (a.count > 3 || count < 1 || count > 100'000'000 || rounds < 1 || rounds > 10'000)
      return bench::wrong_usage("pelage-bench-sort [COUNT [ROUNDS]]; COUNT is 1 to 100,000,000");
    return run(std::size_t(count), int(rounds));
  });
}
