// The rows of results may have only checks whose limits some version of pelage has used.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "harness/compare/tolerances.hpp"
#include "harness/record/contradiction.hpp"

namespace pelage {
namespace {

TEST(WeakestLimits, AreThoseOfTheTolerances) {
  const std::map<std::string, double> tolerances{
      {"psnr", tolerance::other_filter_psnr}, {"p99.9", tolerance::flip}, {"flips", tolerance::flip_share}};
  ASSERT_EQ(weakest_limits().size(), tolerances.size());
  for (const WeakestLimit& weakest : weakest_limits())
    EXPECT_EQ(weakest.limit, tolerances.at(weakest.metric)) << weakest.metric;
}

}  // namespace
}  // namespace pelage
