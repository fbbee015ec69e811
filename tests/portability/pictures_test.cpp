// Draws the same pictures with every OpenCL compiler on this machine and with every mapping
// (docs/machines.md).
#include "tests/support/pictures.hpp"

#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "tests/portability/elsewhere.hpp"
#include "tests/support/synthetic.hpp"
#include "tests/support/texts.hpp"

namespace pelage::portability {
namespace {

using namespace pictures;

struct Sight {
  const char* name;
  std::shared_ptr<const FrameInput> input;
};

/// Returns frames of 160 x 100 pixels and 6 layers: a torus with each shading model, and a square so near to
/// the camera that its triangles cross the near plane and the guard band.
std::vector<Sight> sights() {
  return {{"curling", small_frame("curling", "shared", 6)},
          {"wet", small_frame("wet", "separate", 6)},
          {"near", std::make_shared<FrameInput>(fur_behind_the_eye(6).back().second)}};
}

Picture drawn_by(const cl::Device& device, const FrameInput& input, const std::string& mapping) {
  Shells shells(device, std::make_shared<FrameInput>(input), {mapping, {}});
  shells.advance(frames - 1);
  shells.frame();
  return shells.read();
}

// The tests below run this test in a child process.
TEST(DISABLED_Elsewhere, Pictures) {
  const char* mapping = std::getenv("PELAGE_TEST_MAPPING");
  ASSERT_NE(mapping, nullptr);
  for (const Sight& sight : sights())
    leave(sight.name, drawn_by(cl::choose_device(""), *sight.input, mapping).pixel);
}

std::size_t covered_in_one_only(const Picture& a, const Picture& b) {
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < a.pixel.size(); ++i) pixels += (a.pixel[i].w > 0) != (b.pixel[i].w > 0);
  return pixels;
}

std::vector<std::tuple<Place, std::string>> cases() {
  std::vector<std::tuple<Place, std::string>> all;
  for (const Place& place : places())
    for (const std::string& mapping : place.mappings) all.emplace_back(place, mapping);
  return all;
}

struct Pictures : testing::TestWithParam<std::tuple<Place, std::string>> {};

TEST_P(Pictures, AreThoseOfThisMachinesDeviceAndOfTheReference) {
  const auto& [place, mapping] = GetParam();
  if (const std::string why = obstacle(place, place.slow); !why.empty()) GTEST_SKIP() << why;
  const Elsewhere elsewhere;
  const std::string failure = elsewhere.run(place, "DISABLED_Elsewhere.Pictures", place.slow ? 900 : 200,
                                            "PELAGE_TEST_MAPPING=" + mapping);
  ASSERT_EQ(failure, "");
  for (const Sight& sight : sights()) {
    SCOPED_TRACE(sight.name);
    const Picture reference = drawn_by_reference(*sight.input),
                  here = drawn_by(cl::choose_device(""), *sight.input, "");
    Picture there = here;
    there.pixel = elsewhere.values_of<glm::vec4>(sight.name);
    ASSERT_EQ(there.pixel.size(), here.pixel.size());
    EXPECT_EQ(covered_in_one_only(there, here), 0u);
    EXPECT_EQ(covered_in_one_only(there, reference), 0u);
    const Agreement with_here = compare(there, here), with_reference = compare(there, reference);
    EXPECT_GE(with_here.psnr, tolerance::picture_psnr) << describe(with_here);
    EXPECT_LE(with_here.worst, tolerance::mapping_difference) << describe(with_here);
    EXPECT_TRUE(within(with_reference)) << describe(with_reference);
    EXPECT_GT(with_here.pixels, 5000u);
    std::printf("%s: %s; the reference: %s\n", sight.name, describe(with_here).c_str(),
                describe(with_reference).c_str());
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Pictures, testing::ValuesIn(cases()), pelage::test::by_parameter);

}  // namespace
}  // namespace pelage::portability
