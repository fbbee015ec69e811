#include "harness/measure/quiet.hpp"

#include <gtest/gtest.h>

#include "harness/error.hpp"

namespace pelage {
namespace {

TEST(Quiet, Modes) {
  EXPECT_EQ(quiet_machine_from_text(""), QuietMachine::unchecked);
  EXPECT_EQ(quiet_machine_from_text("warn"), QuietMachine::warn);
  EXPECT_EQ(quiet_machine_from_text("require"), QuietMachine::require);
  EXPECT_THROW(quiet_machine_from_text("yes"), InputError);
}

TEST(Quiet, LooksOnceOrWaits) {
  int asked = 0;
  const auto busy_until = [&asked](int quiet_from) {
    asked = 0;
    return [&asked, quiet_from]() -> std::optional<double> { return ++asked < quiet_from ? 0.42 : 0.05; };
  };
  EXPECT_EQ(disturbance(QuietMachine::unchecked, busy_until(100)), "");
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(disturbance(QuietMachine::warn, busy_until(3)),
            "other processes use 42% of the machine's CPU time");
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(disturbance(QuietMachine::require, busy_until(3)), "");
  EXPECT_EQ(asked, 3);
  EXPECT_NE(disturbance(QuietMachine::require, busy_until(1000)), "");
  EXPECT_EQ(asked, most_waits);
  EXPECT_EQ(disturbance(QuietMachine::require, [] { return std::optional<double>(); }), "");
}

}  // namespace
}  // namespace pelage
