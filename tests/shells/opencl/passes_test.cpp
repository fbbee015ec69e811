// If the vertices of all layers do not fit in memory, pelage draws the layers in several passes. This file
// tests such passes. The picture must have the same bits as the picture drawn in one pass. The numbers of
// fragments must also be equal.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

constexpr int layers = 16;

std::shared_ptr<const FrameInput> wet_frame(const char* faces) {
  Scene scene = synthetic::lively_scene();
  scene.blend.faces = faces;
  scene.shading.model = "wet";
  scene.fur.layers = layers;
  scene.image.width = 61;
  scene.image.height = 45;
  return std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::torus(), 30, 20, 40));
}

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
  const Picture untouched = shells.read();
  EXPECT_EQ(std::memcmp(untouched.pixel.data(), d.picture.pixel.data(),
                        untouched.pixel.size() * sizeof untouched.pixel[0]),
            0)
      << "a tally leaves the picture alone";
  d.counted = shells.count();
  shells.frame();
  d.after = shells.read();
  return d;
}

struct Passes : testing::TestWithParam<const char*> {};

void expect_parts_of_one_picture(const std::shared_ptr<const FrameInput>& input, const char* mapping) {
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
  expect_parts_of_one_picture(wet_frame("all"), GetParam());
}

TEST_P(Passes, OfTwoSweepsAreOnePicture) {
  expect_parts_of_one_picture(wet_frame("back-then-front"), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Device, Passes, testing::Values("tile", "pixel", "group"),
                         [](const auto& given) { return std::string(given.param); });

}  // namespace
}  // namespace pelage
