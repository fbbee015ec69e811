// Tests the comparison of strand tips and wetness masks with the reference: small differences pass, and
// larger differences fail.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "harness/compare/checks.hpp"
#include "harness/compare/tolerances.hpp"

namespace pelage {
namespace {

constexpr double length = 0.1;  // length of a strand, in units of the model's radius R
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::vector<glm::vec3> tips(std::size_t count) {
  return std::vector<glm::vec3>(count, glm::vec3(0, 0, 0.1f));
}

TEST(Tips, OneOfAThousandMayBeOffALittle) {
  const auto reference = tips(2000);
  auto ours = reference;
  ours[7].x += float(0.5 * tolerance::worst_tip * length);
  Spread errors = tip_errors(length, ours, reference);
  EXPECT_NEAR(errors.worst, 0.5 * tolerance::worst_tip, 1e-9);
  EXPECT_TRUE(check_worst_tip(errors).holds());
  EXPECT_TRUE(check_usual_tip(errors).holds());
  ours[8] = ours[9] = ours[7];
  EXPECT_FALSE(check_usual_tip(tip_errors(length, ours, reference)).holds()) << "three of 2000";
  ours = reference;
  ours[1999].y += float(1.1 * tolerance::worst_tip * length);
  errors = tip_errors(length, ours, reference);
  EXPECT_FALSE(check_worst_tip(errors).holds());
  EXPECT_TRUE(check_usual_tip(errors).holds());
}

TEST(Tips, WhatIsNoNumberFails) {
  auto ours = tips(10);
  ours[3].z = nan;
  EXPECT_FALSE(check_worst_tip(tip_errors(length, ours, tips(10))).holds());
  EXPECT_THROW(tip_errors(length, tips(9), tips(10)), std::invalid_argument);
  EXPECT_THROW(tip_errors(length, {}, {}), std::invalid_argument);
}

TEST(Masks, HoldEveryTexel) {
  const std::vector<glm::vec4> reference{{0.1f, 0.2f, 0.03f, 0.9f}, {0, 0, 0, 0}};
  const auto broken = [&](std::size_t texel, glm::vec4 value) {
    auto ours = reference;
    ours[texel] = value;
    std::string text;
    for (const Check& check : check_mask(ours, reference))
      if (!check.holds()) text += check.metric + "; ";
    return text;
  };
  EXPECT_EQ(broken(0, reference[0]), "");
  EXPECT_EQ(broken(0, {0.1f, 0.2f, 0.03f, 0.900005f}), "");
  EXPECT_EQ(broken(0, {0.10002f, 0.2f, 0.03f, 0.9f}), "largest texel error; ");
  EXPECT_EQ(broken(0, {0.1f, nan, 0.03f, 0.9f}), "largest texel error; ");
  EXPECT_EQ(broken(1, {0, 0, 0, 1e-9f}), "texels wet in only one mask; ");
  EXPECT_EQ(broken(0, {0.1f, 0.2f, 0.03f, 0}), "texels wet in only one mask; ");
  EXPECT_THROW(check_mask(reference, {}), std::invalid_argument);
}

}  // namespace
}  // namespace pelage
