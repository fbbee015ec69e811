#include "harness/measure/cpu_use.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <memory>
#include <thread>

#include "harness/error.hpp"
#include "tests/support/busy.hpp"

namespace pelage {
namespace {

void burn(double milliseconds) {
  volatile unsigned x = 1;
  for (const double until = process_cpu_ms() + milliseconds; process_cpu_ms() < until;)
    for (int i = 0; i < 1000; ++i) x = x * 1664525 + 1013904223;
}

TEST(CpuUse, CountsWorkAndNotSleep) {
  EXPECT_GE(cost_of([] { burn(30); }).cpu_ms, 30);
  const Cost asleep = cost_of([] { std::this_thread::sleep_for(std::chrono::milliseconds(100)); });
  EXPECT_GE(asleep.wall_ms, 100);
  EXPECT_LT(asleep.cpu_ms, 50);
}

TEST(CpuUse, CountsAllThreads) {
  const Cost cost = cost_of([] {
    std::thread other([] { burn(40); });
    other.join();
  });
  EXPECT_GE(cost.cpu_ms, 40);
}

TEST(CpuUse, ReadsTheMachinesLine) {
  const auto time = machine_time("cpu  100 50 25 700 20 3 2 100 9 9", 100);
  ASSERT_TRUE(time);
  EXPECT_DOUBLE_EQ(time->total_s, 10);
  EXPECT_DOUBLE_EQ(time->busy_s, 2.8) << "idle and iowait are not busy, steal is";
  EXPECT_DOUBLE_EQ(machine_time("cpu 1 2 3 4", 100).value().busy_s, 0.06) << "as old kernels print it";
  EXPECT_DOUBLE_EQ(machine_time("cpu 1 2 3 4", 100).value().total_s, 0.1);
  EXPECT_FALSE(machine_time("cpu 1 2 3", 100));
  EXPECT_FALSE(machine_time("intr 1 2 3 4 5", 100));
  EXPECT_FALSE(machine_time("", 100));
}

TEST(CpuUse, OthersTakeWhatIsBusyAndNotOurs) {
  EXPECT_DOUBLE_EQ(other_share({10, 100}, {10.125, 100.5}).value(), 0.25);
  EXPECT_DOUBLE_EQ(other_share({10, 100}, {8, 120}).value(), 0) << "a tick counts whole for whom it meets";
  EXPECT_FALSE(other_share({10, 100}, {10, 100}));
}

TEST(CpuWatch, SeesOtherProcessesAndWaitsForTheTicks) {
  const CpuWatch watch;
  std::this_thread::sleep_for(std::chrono::milliseconds(70));
  EXPECT_FALSE(watch.other_share()) << "after 70 ms";
  const test::BusyMachine others;
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  const std::optional<double> share = watch.other_share();
  if (!share) GTEST_SKIP() << "no /proc/stat here, or it stands still";
  EXPECT_GT(*share, 0.5);
}

TEST(CpuWatch, WarnsAboveATenthAndOnlyWhereItIsKnown) {
  Row row;
  row.case_name = "torus-16";
  EXPECT_EQ(load_warning(row), "");
  row.provenance["other_cpu_share"] = 0.1;
  EXPECT_EQ(load_warning(row), "");
  row.provenance["other_cpu_share"] = 0.956;
  EXPECT_EQ(load_warning(row),
            "torus-16: other processes took 96% of the machine's CPU time while this case was timed");
}

constexpr std::size_t much = std::size_t(64) << 20;

TEST(PeakMemory, SeesWhatWasTakenAndGivenBack) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer keeps freed memory in its quarantine, so that the mark does not fall";
#endif
  reset_peak_memory();
  const std::uint64_t before = peak_memory();
  if (before == 0) GTEST_SKIP() << "no VmHWM here";
  {
    const auto block = std::make_unique<char[]>(much);
    std::memset(block.get(), 1, much);
    EXPECT_EQ(block[much / 2], 1);
  }
  const std::uint64_t with = peak_memory();
  EXPECT_GE(with, before + much - (much >> 3));
  EXPECT_EQ(with % 4096, 0u) << "a number of pages, in bytes";
  reset_peak_memory();
  EXPECT_LT(peak_memory(), with);
}

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
    return [&asked, quiet_from] { return std::optional(++asked < quiet_from ? 0.62 : most_other_share); };
  };
  EXPECT_EQ(disturbance(QuietMachine::unchecked, busy_until(100)), "");
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(disturbance(QuietMachine::warn, busy_until(3)),
            "other processes use 62% of the machine's CPU time");
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(disturbance(QuietMachine::require, busy_until(3)), "");
  EXPECT_EQ(asked, 3);
  EXPECT_NE(disturbance(QuietMachine::require, busy_until(1000)), "");
  EXPECT_EQ(asked, 60) << "a minute";
  EXPECT_EQ(disturbance(QuietMachine::require, [] { return std::optional<double>(); }), "");
}

}  // namespace
}  // namespace pelage
