// Tests that the mapping `group` covers the same pixels as the mapping `tile`, that it draws the same picture
// in every run, and that pictures drawn in several passes do not change. picture_test.cpp compares
// the pictures of `group` with the reference. properties_coverage_test.cpp compares the coverage of `group`
// with exact integer computations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "harness/cl/program.hpp"
#include "harness/cl/radix_sort.hpp"
#include "harness/error.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "kernels/rasterize/params.h"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

std::shared_ptr<const FrameInput> tiny_frame(const char* faces = "back-then-front") {
  Scene scene = synthetic::lively_scene();
  scene.blend.faces = faces;
  scene.shading.model = "wet";
  scene.image.width = 61;
  scene.image.height = 45;
  return std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::torus(), 30, 20, 40));
}

TEST(Group, CountsTheFragmentsThatTheOthersCount) {
  const auto input = tiny_frame();
  const auto counted = [&](const char* mapping) {
    Shells shells(device(), input, {mapping, {}});
    shells.frame();
    return shells.count();
  };
  const std::uint64_t tile = counted("tile");
  EXPECT_GT(tile, 10000u);
  EXPECT_EQ(counted("group"), tile);
  EXPECT_EQ(counted("pixel"), tile);
}

TEST(Group, CoversThePixelsThatTilesCover) {
  // The test draws a fan of thin triangles around one point. Some corners are beyond the guard band. The
  // second value of row_w makes the clip coordinate w depend on y, so some triangles also cross the near
  // plane.
  for (const glm::vec4 row_w : {glm::vec4(0, 0, -.5f, 1), glm::vec4(0, .001f, -.5f, 1)}) {
    Flat flat{{{3, -7}}, {}, 131, 77, row_w};
    constexpr std::uint32_t spokes = 40;
    for (std::uint32_t i = 0; i < spokes; ++i) {
      const float angle = 6.2831853f * float(i) / spokes, radius = i % 2 ? 60.f : 90000.f;
      flat.vertex.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
      flat.triangle.emplace_back(0, 1 + i, 1 + (i + 1) % spokes);
    }
    const std::vector<int> tile = covered_counts(flat, {"tile", {}});
    EXPECT_GT(std::count(tile.begin(), tile.end(), 1), 3000);
    EXPECT_TRUE(covered_counts(flat, {"group", {}}) == tile);
  }
}

TEST(Group, TwentyRunsAreOnePicture) {
  const auto input = tiny_frame();
  const auto drawn = [&](const std::map<std::string, int>& tuning) {
    Shells shells(device(), input, {"group", tuning});
    shells.frame();
    return shells.read();
  };
  const Picture first = drawn({});
  EXPECT_GT(std::count_if(first.pixel.begin(), first.pixel.end(), [](const glm::vec4& p) { return p.w > 0; }),
            500);
  for (int run = 1; run < 20; ++run) EXPECT_TRUE(same_bits(first, drawn({}))) << "run " << run;
  // The mapping `group` processes the layers in batches. The number of layers per batch (GROUP) must not
  // change the picture.
  for (const int group : {1, 3, 16}) EXPECT_TRUE(same_bits(first, drawn({{"GROUP", group}}))) << group;
}

TEST(Group, DrawsNothingWhereNothingIs) {
  // The camera looks past the mesh, so every triangle list is empty, and every pixel must have the
  // background colour.
  FrameInput input = *tiny_frame();
  input.scene.image.background = {.1f, .2f, .3f};
  input.scene.camera.target = {40, 1, 40};
  input.camera = synthetic::camera(input.scene.camera, 61, 45);
  Shells shells(device(), std::make_shared<FrameInput>(input), {"group", {}});
  shells.frame();
  const Picture picture = shells.read();
  ASSERT_EQ(picture.pixel.size(), 61u * 45u);
  EXPECT_TRUE(std::all_of(picture.pixel.begin(), picture.pixel.end(),
                          [](const glm::vec4& pixel) { return pixel == glm::vec4(.1f, .2f, .3f, 0); }));
}

TEST(Group, IsWhatDevicesOfOneLaneDrawWith) {
  cl::DeviceInfo gpu, cpu;
  gpu.gpu = true;
  cpu.cpu = true;
  cpu.lanes = 16;
  EXPECT_EQ(default_mapping(gpu), "group");
  EXPECT_EQ(default_mapping(cpu), "tile");
  EXPECT_EQ(mappings_on(cpu), mappings());
  EXPECT_EQ(mappings_on(gpu).front(), "group");
  EXPECT_EQ(std::ranges::count(mappings_on(gpu), "tile"), 0);
  cpu.lanes = 1;
  EXPECT_EQ(mappings_on(cpu), mappings_on(gpu));
  EXPECT_EQ(offered_mapping("", gpu), "group");
  EXPECT_EQ(offered_mapping("pixel", gpu), "pixel");
  EXPECT_THROW(offered_mapping("tile", gpu), InputError);
}

// If the vertices of all layers do not fit in memory, pelage draws the layers in several passes. The picture
// must have the same bits as the picture drawn in one pass, and the numbers of fragments must be equal.
constexpr int layers = 16;

struct Drawn {
  Picture picture, after;  // `after` is the next frame, drawn after the fragments were counted
  std::uint64_t counted;
  Tally tally;
};

Drawn drawn_in_passes(const std::shared_ptr<const FrameInput>& input, const std::string& mapping,
                      int layers_at_once) {
  Shells shells(device(), input, {mapping, {}, layers_at_once});
  shells.frame();
  Drawn d;
  d.picture = shells.read();
  d.tally = shells.tally(1);
  EXPECT_TRUE(same_bits(shells.read(), d.picture)) << "a tally leaves the picture alone";
  d.counted = shells.count();
  shells.frame();
  d.after = shells.read();
  return d;
}

struct Passes : testing::TestWithParam<std::string> {};

void expect_parts_of_one_picture(const std::shared_ptr<const FrameInput>& input, const std::string& mapping) {
  const Drawn whole = drawn_in_passes(input, mapping, layers);
  EXPECT_GT(whole.tally.blended, 1000u);
  // The 16 layers are drawn with at most 7, 3 or 1 layers per pass. pelage rounds 7 down to 4, the size of a
  // layer batch. With 3 layers per pass, a pass has fewer layers than a layer batch, and the sixth pass has
  // only one layer.
  for (const int at_once : {7, 3, 1}) {
    SCOPED_TRACE(at_once);
    const Drawn parts = drawn_in_passes(input, mapping, at_once);
    EXPECT_TRUE(same_bits(parts.picture, whole.picture));
    EXPECT_TRUE(same_bits(parts.after, whole.after));
    EXPECT_EQ(parts.counted, whole.counted);
    EXPECT_EQ(parts.tally.covered, whole.tally.covered);
    EXPECT_EQ(parts.tally.shaded, whole.tally.shaded);
    EXPECT_EQ(parts.tally.blended, whole.tally.blended);
  }
}

TEST_P(Passes, ArePartsOfOnePicture) {
  expect_parts_of_one_picture(tiny_frame("all"), GetParam());
}

TEST_P(Passes, OfTwoSweepsAreOnePicture) {
  expect_parts_of_one_picture(tiny_frame("back-then-front"), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Device, Passes, testing::ValuesIn(mappings()), test::by_parameter);

// Shells::tally() counts fragments with the mapping `pixel`, and Shells::count() with the mapping that draws
// the pictures. A tally may be an estimate from a random sample of pixels.
TEST(Tally, TwoMappingsCountTheSameAndASampleComesNear) {
  Shells shells(pictures::device(), pictures::small_frame("curling"), {});
  shells.frame();
  const Picture before = shells.read();
  const Tally exact = shells.tally(1);
  EXPECT_EQ(exact.covered, shells.count());
  EXPECT_GT(exact.blended, 0u);
  EXPECT_LE(exact.blended, exact.shaded);
  EXPECT_LT(exact.shaded, exact.covered);
  const Tally sample = shells.tally(16);
  EXPECT_NEAR(double(sample.covered) / double(exact.covered), 1, 0.1);
  EXPECT_NEAR(double(sample.shaded) / double(exact.shaded), 1, 0.1);
  EXPECT_NEAR(double(sample.blended) / double(exact.blended), 1, 0.1);
  EXPECT_EQ(compare(before, shells.read()).worst, 0) << "counting draws nothing";
}

// Tests how triangles are sorted into lists. The mapping `group` uses prefix sums and a radix sort, which are
// compared with std::exclusive_scan and std::stable_sort. The other mappings store one list per tile; the
// kernel bin_start computes the position in a buffer at which each list starts.

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
