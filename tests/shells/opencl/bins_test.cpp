// Tests how triangles are sorted into lists. The mapping `group` uses prefix sums and a radix sort, which are
// compared with std::exclusive_scan and std::stable_sort. The other mappings store one list per tile; the
// kernel bin_start computes the position in a buffer at which each list starts.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "harness/cl/program.hpp"
#include "harness/cl/radix_sort.hpp"
#include "kernels/rasterize/params.h"
#include "tests/shells/opencl/picture_scenes.hpp"

namespace pelage {
namespace {

using Values = std::vector<std::int32_t>;

Values random_values(std::size_t count, std::int32_t below, std::uint32_t seed) {
  std::mt19937 random(seed);
  Values values(count);
  for (std::int32_t& v : values) v = std::int32_t(random() % std::uint32_t(below));
  return values;
}

cl::Buffer<std::int32_t> on_device(const cl::Queue& queue, const Values& values) {
  return cl::Buffer<std::int32_t>(queue, std::span<const std::int32_t>(values));
}

TEST(RadixSort, PrefixSumsAreExact) {
  const cl::Queue queue(pictures::device());
  cl::RadixSort sort(queue.device());
  // The kernels sum blocks of 1024 values, and then sum the blocks' sums in the same way. Up to 1024 values
  // need one level of sums, 1025 and 100,000 values two levels, and 1,048,577 values three levels.
  for (const std::size_t count : {1u, 15u, 1023u, 1024u, 1025u, 100000u, 1048577u}) {
    const Values values = random_values(count, 1000, std::uint32_t(count));
    const cl::Buffer<std::int32_t> buffer = on_device(queue, values);
    const std::int32_t sum = sort.scan(queue, buffer, count, nullptr, true);
    Values expected(count);
    std::exclusive_scan(values.begin(), values.end(), expected.begin(), 0);
    EXPECT_EQ(sum, expected.back() + values.back()) << count;
    EXPECT_TRUE(buffer.read(queue) == expected) << count;
  }
}

TEST(RadixSort, SumsThatAreTooLargeAreSeen) {
  const cl::Queue queue(pictures::device());
  cl::RadixSort sort(queue.device());
  constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
  const std::size_t count = 5000;
  for (const std::int32_t each : {most / 4000, most / 5000}) {
    const cl::Buffer<std::int32_t> values = on_device(queue, Values(count, each));
    const std::int32_t sum = sort.scan(queue, values, count, nullptr, true);
    EXPECT_EQ(sum, each == most / 4000 ? most : most / 5000 * 5000);
    // The kernels must clamp every prefix sum to `most`, not only the sum of all values.
    Values expected(count);
    for (std::size_t i = 0; i < count; ++i)
      expected[i] = std::int32_t(std::min<std::int64_t>(most, std::int64_t(i) * each));
    EXPECT_TRUE(values.read(queue) == expected) << each;
  }
}

TEST(RadixSort, IsStable) {
  const cl::Queue queue(pictures::device());
  cl::RadixSort sort(queue.device());
  for (const auto& [count, bits] :
       {std::pair{0u, 4}, {1u, 1}, {31u, 3}, {32u, 4}, {3333u, 9}, {70000u, 17}}) {
    const Values keys = random_values(count, 1 << bits, count);
    Values order(count);
    std::iota(order.begin(), order.end(), 0);
    cl::Buffer<std::int32_t> key = on_device(queue, keys), value = on_device(queue, order);
    sort.sort(queue, key, value, count, bits, nullptr);
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return keys[std::size_t(a)] < keys[std::size_t(b)]; });
    Values moved = value.read(queue);
    moved.resize(count);  // the buffer may be longer than `count`
    EXPECT_TRUE(moved == order) << count << " keys of " << bits << " bits";
  }
}

/// Runs the kernel bin_start for lists with the given lengths. Returns the start position of each list,
/// followed by the sum of all lengths.
Values starts(const Values& length) {
  const cl::Queue queue(pictures::device());
  const cl::Program program(queue.device(), "rasterize/geometry/geometry.cl", "-D LANES=1");
  RasterParams params{};
  params.tiles_x = int(length.size());
  params.tiles_y = 1;
  const cl::Buffer<std::int32_t> lengths(queue, std::span<const std::int32_t>(length));
  const cl::Buffer<std::int32_t> start(queue, std::span<const std::int32_t>(Values(length.size() + 1, -1)));
  const cl::Buffer<std::int32_t> next(queue, std::span<const std::int32_t>(Values{7}));
  const cl::Event event =
      cl::Kernel(program, "bin_start").with(params, lengths, start, next).enqueue(queue, 1);
  queue.finish();
  EXPECT_EQ(next.read(queue), Values{0});
  return start.read(queue);
}

TEST(Bins, ListsFollowOneAnother) {
  EXPECT_EQ(starts({3, 0, 4, 1}), (Values{0, 3, 3, 7, 8}));
}

// The host allocates a buffer for as many entries as the sum of the lengths. The sum must therefore not wrap
// around to a small or negative number.
TEST(Bins, ASumBeyondWholeNumbersStaysAtTheMost) {
  constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(starts({most / 2, most / 2, 1}).back(), most);
  EXPECT_EQ(starts({most / 2, most / 2, most / 2, 5}).back(), most);
  EXPECT_EQ(starts({most, most, 3}).back(), most);
}

}  // namespace
}  // namespace pelage
