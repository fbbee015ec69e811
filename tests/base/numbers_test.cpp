#include "harness/base/numbers.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "harness/base/median.hpp"

namespace pelage {
namespace {

TEST(Numbers, SizesAreTwoNumbersOfDigits) {
  const std::optional<Size> size = size_from_text("800x600");
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 800);
  EXPECT_EQ(size->height, 600);
  for (const char* text : {"", "x", "800", "800x", "x600", "-800x600", "800x-600", "800x600x2", "8e2x600",
                           " 800x600", "1234567890x1", "1x1234567890"})
    EXPECT_FALSE(size_from_text(text)) << text;
}

TEST(Numbers, OfATextAreItsValueOrItsPixels) {
  EXPECT_EQ(number_of("64"), 64);
  EXPECT_EQ(number_of("-0.5"), -0.5);
  EXPECT_EQ(number_of("800x600"), 480000);
  EXPECT_EQ(number_of("99999x99999"), 99999.0 * 99999.0);
  for (const char* text : {"", "torus", "inf", "nan", "64 layers", "1x"})
    EXPECT_FALSE(number_of(text)) << text;
}

TEST(Median, IsTheMeanOfTheTwoMiddleValues) {
  for (const auto& [values, middle] :
       {std::pair(std::vector<double>{7}, 7.0), std::pair(std::vector<double>{4, 1}, 2.5),
        std::pair(std::vector<double>{9, 1, 2}, 2.0), std::pair(std::vector<double>{100, 3, 2, 1}, 2.5)}) {
    std::vector<double> changed = values;
    EXPECT_EQ(median(values), middle);
    EXPECT_EQ(median_reordering(changed), middle);
    EXPECT_EQ(quantile(values, 0.5), middle);
  }
}

TEST(Median, QuantilesAreInterpolated) {
  const std::vector<double> values{40, 10, 30, 20};
  EXPECT_EQ(quantile(values, 0), 10);
  EXPECT_EQ(quantile(values, 0.25), 17.5);
  EXPECT_EQ(quantile(values, 1), 40);
}

}  // namespace
}  // namespace pelage
