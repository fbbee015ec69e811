// pelage groom: the files are read here as their formats are described, without pelage's own code.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <sstream>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

struct Groom : InFolder {
  /// Upright strands of equal lengths on a square that is normal to the y axis.
  std::string upright(const std::string& output) {
    folder.write("fur.toml", R"toml(model = "square"
pipeline = "strands"
[strands]
segments = 4
taper = 0.5
[[strands.layer]]
count = 300
length = 0.25
length_spread = 0
width = 0.01
lean = 0
colour = [1.0, 0.5, 0.25]
colour_spread = 0
[coat]
pattern = "plain"
colour = [0.8, 0.8, 0.8]
)toml");
    return done("groom fur.toml -o " + output).out;
  }
};

TEST_F(Groom, HairFilesHaveTheStrands) {
  EXPECT_EQ(upright("fur.hair"), "fur.hair: 300 strands of 5 points\n");
  const std::string bytes = folder.read("fur.hair");
  const auto whole = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, &bytes[at], sizeof value);
    return value;
  };
  const auto real = [&](std::size_t at) {
    float value = 0;
    std::memcpy(&value, &bytes[at], sizeof value);
    return value;
  };
  ASSERT_EQ(bytes.size(), 128u + 1500u * (12 + 4 + 12));
  EXPECT_EQ(bytes.substr(0, 4), "HAIR");
  EXPECT_EQ(whole(4), 300u);
  EXPECT_EQ(whole(8), 1500u);
  EXPECT_EQ(whole(12), 2u + 4 + 16) << "points, widths and colours";
  EXPECT_EQ(whole(16), 4u) << "segments of each strand";
  const std::size_t count = 1500, points = 128, widths = points + count * 12, colours = widths + count * 4;
  for (std::size_t i = 0; i < 1500; ++i) {
    const std::size_t root = i / 5 * 5;
    const float t = float(i % 5) / 4;
    EXPECT_EQ(real(points + 12 * i), real(points + 12 * root));
    EXPECT_NEAR(real(points + 12 * i + 4), 0.25f * t, 1e-6f);
    EXPECT_EQ(real(points + 12 * i + 8), real(points + 12 * root + 8));
    EXPECT_NEAR(real(widths + 4 * i), 0.01f * (1 - 0.5f * t), 1e-8f);
    EXPECT_NEAR(real(colours + 12 * i), 0.8f, 0.5f / 255);
    EXPECT_NEAR(real(colours + 12 * i + 4), 0.4f, 0.5f / 255);
    EXPECT_NEAR(real(colours + 12 * i + 8), 0.2f, 0.5f / 255);
  }
}

TEST_F(Groom, ObjFilesHaveTheSamePoints) {
  upright("fur.hair");
  EXPECT_EQ(upright("fur.obj"), "fur.obj: 300 strands of 5 points\n");
  const std::string bytes = folder.read("fur.hair");
  std::istringstream text(folder.read("fur.obj"));
  std::size_t points = 0, lines = 0;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      for (std::size_t k = 0; k < 3; ++k) {
        float value = 0, wanted = 0;
        words >> value;
        std::memcpy(&wanted, &bytes[128 + 12 * points + 4 * k], sizeof wanted);
        EXPECT_EQ(value, wanted);
      }
      ++points;
    }
    if (word == "l")
      for (std::size_t k = 1, index = 0; k <= 5; ++k) {
        words >> index;
        EXPECT_EQ(index, 5 * lines + k);
      }
    lines += word == "l";
  }
  EXPECT_EQ(points, 1500u);
  EXPECT_EQ(lines, 300u);
}

TEST_F(Groom, OtherFilesAreRefused) {
  expect_refused(pelage("groom straight -o fur.txt"), "fur.txt: strands are written as .hair or .obj");
  expect_refused(pelage("groom straight -o no/fur.obj"), "the folder 'no' does not exist");
}

}  // namespace
}  // namespace pelage::cli
