// The mapping `group` (a way to assign pixels to work-items) bins triangles with prefix sums and a radix
// sort. This file compares their results with std::exclusive_scan and std::stable_sort.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "harness/cl/radix_sort.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"

namespace pelage::shells {
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

}  // namespace
}  // namespace pelage::shells
