#include "harness/base/median.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pelage {
namespace {

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
