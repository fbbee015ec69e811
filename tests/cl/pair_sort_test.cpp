// Compares the device's sort of pairs with std::stable_sort. The results must be equal, for every number of
// runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>

#include "harness/cl/radix_sort.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

using cl::Pair;

struct Keys {
  std::string name;
  std::function<std::uint32_t(std::uint32_t index, std::uint32_t random)> of;
};

// Random keys, and keys that are difficult for a radix sort: equal digits, digits of which one run has all,
// and keys whose order as signed numbers differs from their order as unsigned numbers.
const std::vector<Keys> kinds = {
    {"random", [](std::uint32_t, std::uint32_t random) { return random; }},
    {"equal", [](std::uint32_t, std::uint32_t) { return 0x80402010u; }},
    {"rising", [](std::uint32_t i, std::uint32_t) { return i; }},
    {"falling", [](std::uint32_t i, std::uint32_t) { return ~i; }},
    {"two values", [](std::uint32_t i, std::uint32_t) { return i & 1 ? 0x80000000u : 0x7fffffffu; }},
    {"one digit", [](std::uint32_t, std::uint32_t random) { return random & 0x00ff0000u; }},
    {"few values", [](std::uint32_t, std::uint32_t random) { return (random % 5) * 0x01010101u; }},
    {"saw", [](std::uint32_t i, std::uint32_t) { return (i % 1000) << 22; }}};

/// Returns `count` pairs whose values are their indices.
std::vector<Pair> pairs_of(const Keys& kind, std::size_t count) {
  std::mt19937 random(7);
  std::vector<Pair> pairs(count);
  for (std::uint32_t i = 0; i < count; ++i) pairs[i] = {kind.of(i, std::uint32_t(random())), i};
  return pairs;
}

std::vector<Pair> expected(std::vector<Pair> pairs) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.key < b.key; });
  return pairs;
}

/// Sorts on the device. `gap` is the number of unused places behind the pairs of each run.
std::vector<Pair> sorted(const cl::Queue& queue, const std::vector<Pair>& pairs, int runs, std::size_t gap,
                         int bits) {
  cl::PairSort sort(queue.device(), runs);
  const std::size_t length = sort.capacity(pairs.size()), capacity = length + gap;
  std::vector<Pair> spread(capacity * std::size_t(sort.runs()), Pair{0, 0xffffffffu});
  std::vector<std::int32_t> live(std::size_t(sort.runs()), 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t run = i / length;
    spread[run * capacity + i % length] = pairs[i];
    ++live[run];
  }
  cl::Buffer<Pair> buffer(queue, spread);
  sort.sort(queue, buffer, cl::Buffer<std::int32_t>(queue, live), capacity, bits);
  EXPECT_EQ(sort.total().read(queue), std::vector<std::int32_t>{std::int32_t(pairs.size())});
  std::vector<Pair> result(pairs.size());
  buffer.read(queue, result);
  return result;
}

TEST(PairSort, EqualsAStableSortForEveryNumberOfRuns) {
  const cl::Queue queue(cl::choose_device(""));
  for (const Keys& kind : kinds) {
    for (const std::size_t count : {1u, 2u, 255u, 4099u}) {
      const std::vector<Pair> pairs = pairs_of(kind, count), want = expected(pairs);
      for (const auto& [runs, gap] : std::initializer_list<std::pair<int, std::size_t>>{
               {0, 0}, {0, 5}, {1, 0}, {3, 0}, {17, 5}, {64, 0}, {1000, 5}})
        EXPECT_EQ(sorted(queue, pairs, runs, gap, 32), want) << kind.name << ", " << count << " in " << runs;
    }
  }
}

TEST(PairSort, SortsTenMillionPairs) {
  const cl::Queue queue(cl::choose_device(""));
  for (const Keys& kind : kinds) {
    const std::vector<Pair> pairs = pairs_of(kind, 10'000'000);
    EXPECT_TRUE(sorted(queue, pairs, 0, 0, 32) == expected(pairs)) << kind.name;
  }
  const std::vector<Pair> pairs = pairs_of(kinds[0], 10'000'000), want = expected(pairs);
  for (const int runs : {1, 2, 3, 7, 64, 65536})
    EXPECT_TRUE(sorted(queue, pairs, runs, 0, 32) == want) << "random, " << runs << " runs";
}

TEST(PairSort, SortsByTheLowBitsOnly) {
  const cl::Queue queue(cl::choose_device(""));
  const Keys low{"24 bits", [](std::uint32_t, std::uint32_t random) { return random >> 8; }};
  const std::vector<Pair> pairs = pairs_of(low, 100'000);
  EXPECT_TRUE(sorted(queue, pairs, 0, 0, 24) == expected(pairs));
}

TEST(PairSort, SortsNothingAndEmptyRuns) {
  const cl::Queue queue(cl::choose_device(""));
  cl::PairSort sort(queue.device(), 4);
  cl::Buffer<Pair> pairs(queue, std::vector<Pair>{{9, 0}, {9, 1}, {3, 2}, {9, 3}});
  sort.sort(queue, pairs, cl::Buffer<std::int32_t>(queue, std::vector<std::int32_t>{0, 0, 0, 0}), 1, 32);
  EXPECT_EQ(sort.total().read(queue).front(), 0);
  cl::Buffer<Pair> more(queue, std::vector<Pair>{{9, 0}, {9, 1}, {3, 2}, {9, 3}});
  sort.sort(queue, more, cl::Buffer<std::int32_t>(queue, std::vector<std::int32_t>{1, 0, 1, 1}), 1, 32);
  EXPECT_EQ(sort.total().read(queue).front(), 3);
  std::vector<Pair> three(3);
  more.read(queue, three);
  EXPECT_EQ(three, (std::vector<Pair>{{3, 2}, {9, 0}, {9, 3}}));
}

TEST(PairSort, RefusesAnImpossibleNumberOfRuns) {
  const cl::Device device = cl::choose_device("");
  EXPECT_THROW(cl::PairSort(device, -1), InputError);
  EXPECT_THROW(cl::PairSort(device, 65537), InputError);
}

}  // namespace
}  // namespace pelage
