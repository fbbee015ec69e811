#include "harness/picture/image_io.hpp"

#include <gtest/gtest.h>

#include <numeric>


namespace pelage {
namespace {

/// Returns a picture in which the red value of each pixel is its column and the green value is its row.
Picture ramp(int width, int height) {
  Picture picture{width, height, std::vector<glm::vec4>(std::size_t(width) * std::size_t(height))};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.at(x, y) = {float(x), float(y), 1, 1};
  return picture;
}

TEST(Reduce, AWholeFactorAveragesBlocks) {
  const Picture small = reduced(ramp(8, 4), 4);
  ASSERT_EQ(small.width, 4);
  ASSERT_EQ(small.height, 2);
  EXPECT_FLOAT_EQ(small.at(0, 0).x, 0.5f);
  EXPECT_FLOAT_EQ(small.at(3, 1).x, 6.5f);
  EXPECT_FLOAT_EQ(small.at(3, 1).y, 2.5f);
  EXPECT_FLOAT_EQ(small.at(2, 0).z, 1.0f);
}

TEST(Reduce, AnyFactorKeepsTheMean) {
  const Picture full = ramp(37, 23), small = reduced(full, 10);
  ASSERT_EQ(small.height, 6);
  const auto mean = [](const Picture& picture) {
    const glm::vec4 sum = std::accumulate(picture.pixel.begin(), picture.pixel.end(), glm::vec4(0));
    return sum / float(picture.pixel.size());
  };
  EXPECT_NEAR(mean(small).x, mean(full).x, 1e-4);
  EXPECT_NEAR(mean(small).y, mean(full).y, 1e-4);
  EXPECT_NEAR(mean(small).w, 1, 1e-5);
}

TEST(Reduce, ASmallPictureIsUnchanged) {
  EXPECT_EQ(reduced(ramp(5, 3), 5).pixel, ramp(5, 3).pixel);
}

TEST(Reduce, OneRowRemains) {
  EXPECT_EQ(reduced(ramp(1000, 1), 10).height, 1);
}

TEST(Reduce, WebpHasItsSignature) {
  Picture picture = ramp(16, 8);
  for (glm::vec4& pixel : picture.pixel) pixel *= 0.05f;
  const std::string bytes = webp_of(picture, 80);
  ASSERT_GT(bytes.size(), 20u);
  EXPECT_EQ(bytes.substr(0, 4), "RIFF");
  EXPECT_EQ(bytes.substr(8, 4), "WEBP");
  EXPECT_LT(bytes.size(), webp_of(picture, 100).size() + 1);
}

}  // namespace
}  // namespace pelage
