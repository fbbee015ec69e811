// Tests the kernel bin_start. The kernels divide the picture into tiles and store one list of triangles per
// tile. bin_start computes the position in a buffer at which each list starts.
#include <gtest/gtest.h>

#include <limits>

#include "harness/cl/program.hpp"
#include "kernels/rasterize/params.h"
#include "tests/shells/opencl/picture_scenes.hpp"

namespace pelage {
namespace {

using Values = std::vector<std::int32_t>;

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
