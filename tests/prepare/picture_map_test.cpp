#include "harness/prepare/picture_map.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "harness/error.hpp"
#include "harness/picture/image_io.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// Writes a picture of 2 x 2 pixels as EXR, whose values are not rounded, and returns its path.
fs::path written(const Picture& picture) {
  const fs::path path = fs::temp_directory_path() / ("picture-map-" + std::to_string(getpid()) + ".exr");
  write_picture(path, picture);
  return path;
}

Picture four(float top_left, float top_right, float bottom_left, float bottom_right) {
  Picture picture{2, 2, {}};
  for (const float value : {top_left, top_right, bottom_left, bottom_right})
    picture.pixel.emplace_back(value, 2 * value, 3 * value, 1);
  return picture;
}

TEST(PictureMap, InterpolatesBetweenPixelCentresWithTheTopRowAtVOfOne) {
  const fs::path path = written(four(0.1f, 0.2f, 0.3f, 0.4f));
  const PictureMap map(path);
  fs::remove(path);
  EXPECT_EQ(map.width(), 2);
  EXPECT_EQ(map.height(), 2);
  EXPECT_FLOAT_EQ(map.at({0.25, 0.75}).x, 0.1f);
  EXPECT_FLOAT_EQ(map.at({0.75, 0.75}).x, 0.2f);
  EXPECT_FLOAT_EQ(map.at({0.25, 0.25}).y, 0.6f);
  EXPECT_FLOAT_EQ(map.at({0.75, 0.25}).z, 1.2f);
  EXPECT_FLOAT_EQ(map.at({0.5, 0.5}).x, 0.25f);
  EXPECT_FLOAT_EQ(map.at({0.5, 0.75}).x, 0.15f);
  EXPECT_FLOAT_EQ(map.at({-3, 5}).x, 0.1f);  // outside the unit square
  EXPECT_FLOAT_EQ(map.at({7, -1}).x, 0.4f);
}

TEST(PictureMap, RefusesNegativeValues) {
  const fs::path path = written(four(0.1f, -0.2f, 0.3f, 0.4f));
  EXPECT_THROW(PictureMap{path}, InputError);
  fs::remove(path);
}

}  // namespace
}  // namespace pelage
