// Tests the measurement of the CPU time of this process and of other processes.
#include "harness/measure/cpu_use.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

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
  EXPECT_TRUE(machine_time("cpu 1 2 3 4", 100));
  EXPECT_FALSE(machine_time("cpu 1 2 3", 100));
  EXPECT_FALSE(machine_time("intr 1 2 3 4 5", 100));
  EXPECT_FALSE(machine_time("", 100));
}

TEST(CpuUse, OthersTakeWhatIsBusyAndNotOurs) {
  EXPECT_DOUBLE_EQ(other_share({10, 100}, {17, 120}, 2).value(), 0.25);
  EXPECT_DOUBLE_EQ(other_share({10, 100}, {17, 120}, 7).value(), 0);
  EXPECT_DOUBLE_EQ(other_share({10, 100}, {17, 120}, 9).value(), 0)
      << "a tick counts whole for whom it meets";
  EXPECT_FALSE(other_share({10, 100}, {10, 100}, 0));
}

TEST(CpuWatch, SeesOtherProcessesAndWaitsForTheTicks) {
  const CpuWatch watch;
  EXPECT_FALSE(watch.other_share()) << "at once";
  std::vector<pid_t> children;
  for (long i = 0; i < sysconf(_SC_NPROCESSORS_ONLN); ++i) {
    const pid_t child = fork();
    if (child == 0)
      for (;;) burn(1000);
    children.push_back(child);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  const std::optional<double> share = watch.other_share();
  for (const pid_t child : children) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  if (!share) GTEST_SKIP() << "no /proc/stat here, or it stands still";
  EXPECT_GT(*share, 0.5);
}

TEST(CpuWatch, WarnsAboveATenthAndOnlyWhereItIsKnown) {
  Row row;
  row.case_name = "torus-16";
  EXPECT_EQ(load_warning(row), "");
  row.provenance["other_cpu_share"] = 0.1;
  EXPECT_EQ(load_warning(row), "");
  row.provenance["other_cpu_share"] = 0.426;
  EXPECT_EQ(load_warning(row),
            "torus-16: other processes took 43% of the machine's CPU time while this case was timed");
}

}  // namespace
}  // namespace pelage
