// Tests that text is painted where the scene places it, and that fonts which cannot be read are refused.

#include <algorithm>
#include <limits>

#include "harness/picture/image_module.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

constexpr int side = 400;

/// The smallest rectangle in UV that contains all pixels inside letters.
struct Bounds {
  double left = 1, right = 0, low = 1, high = 0;
};

Bounds bounds_of(const TextMask& mask) {
  Bounds b;
  for (int y = 0; y < mask.side; ++y)
    for (int x = 0; x < mask.side; ++x) {
      const double u = (x + 0.5) / mask.side, v = 1.0 - (y + 0.5) / mask.side;
      if (!mask.inside(u, v)) continue;
      b.left = std::min(b.left, u), b.right = std::max(b.right, u);
      b.low = std::min(b.low, v), b.high = std::max(b.high, v);
    }
  return b;
}

std::string failure_of(const TextLine& line) {
  return test::refusal([&] { paint_text(line, side); }, "");
}

TEST(TextMask, HasItsCentreAndHeightWhereTheyAreGiven) {
  for (const double height : {0.1, 0.4}) {
    const Bounds b = bounds_of(paint_text({"H", default_font(), 0.3, 0.7, height}, side));
    // A border of a letter is rounded to a pixel, and the font's size to a whole number.
    EXPECT_NEAR(b.high - b.low, height, 4.0 / side);
    EXPECT_NEAR(0.5 * (b.left + b.right), 0.3, 2.0 / side);
    EXPECT_NEAR(0.5 * (b.low + b.high), 0.7, 2.0 / side);
  }
}

TEST(TextMask, IsReadableFromLeftToRightAndUpright) {
  // The letter L has its stem on the left and its bar below.
  const TextMask mask = paint_text({"L", default_font(), 0.5, 0.5, 0.6}, side);
  const Bounds b = bounds_of(mask);
  const double edge = 0.04;
  EXPECT_TRUE(mask.inside(b.left + edge, b.high - edge));
  EXPECT_TRUE(mask.inside(b.left + edge, b.low + edge));
  EXPECT_TRUE(mask.inside(b.right - edge, b.low + edge));
  EXPECT_FALSE(mask.inside(b.right - edge, b.high - edge));
  EXPECT_FALSE(mask.inside(0.5, 1.5));
  EXPECT_FALSE(mask.inside(std::numeric_limits<double>::quiet_NaN(), 0.5));
}

TEST(TextMask, TextThatLeavesTheSquareIsRefused) {
  test::expect_has(failure_of({"CGI10", default_font(), 0.5, 0.5, 0.5}), "leaves the unit square");
  test::expect_has(failure_of({"I", default_font(), 0.01, 0.5, 0.5}), "leaves the unit square");
  EXPECT_EQ(failure_of({"I", default_font(), 0.5, 0.5, 0.5}), "");
}

TEST(TextMask, FilesThatAreNoFontsAreRefused) {
  test::expect_has(failure_of({"I", "missing.ttf"}), "missing.ttf: there is no such font file");
  const test::Folder folder;
  const std::string file = folder.write("a.ttf", "not a font");
  test::expect_has(failure_of({"I", file}), "not a readable font");
  // A font that is cut off must not crash the program.
  folder.write("a.ttf", test::text_of(default_font()).substr(0, 20000));
  test::expect_has(failure_of({"I", file}), file);
}

}  // namespace
}  // namespace pelage
