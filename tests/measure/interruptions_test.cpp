#include "harness/measure/interruptions.hpp"

#include <gtest/gtest.h>

#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using test::expect_has;

struct Cgroups : test::InFolder {
  std::optional<double> quota(const std::string& groups) const { return cpu_quota(folder.path, groups); }
};

TEST_F(Cgroups, TheSmallestQuotaOfVersion2Counts) {
  fs::create_directories(folder.path / "job/step");
  EXPECT_FALSE(quota("0::/job/step\n"));
  folder.write("job/cpu.max", "150000 100000\n");
  folder.write("job/step/cpu.max", "max 100000\n");
  EXPECT_DOUBLE_EQ(quota("0::/job/step\n").value(), 1.5);
  folder.write("job/step/cpu.max", "50000 100000\n");
  EXPECT_DOUBLE_EQ(quota("0::/job/step\n").value(), 0.5);
  EXPECT_FALSE(quota("0::/\n")) << "another group's quota";
  folder.write("cpu.max", "200000 100000\n");
  EXPECT_DOUBLE_EQ(quota("0::/a/folder/outside/of/the/container\n").value(), 2);
}

TEST_F(Cgroups, QuotasOfVersion1AreReadToo) {
  fs::create_directories(folder.path / "cpu,cpuacct/slurm");
  folder.write("cpu,cpuacct/slurm/cpu.cfs_quota_us", "50000\n");
  folder.write("cpu,cpuacct/slurm/cpu.cfs_period_us", "100000\n");
  folder.write("cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  folder.write("cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  EXPECT_DOUBLE_EQ(quota("9:memory:/slurm\n4:cpu,cpuacct:/slurm\n").value(), 0.5);
  EXPECT_FALSE(quota("9:memory:/slurm\n4:cpuset:/slurm\n"));
  EXPECT_FALSE(quota("nonsense\n::\n:\n"));
}

TEST_F(Cgroups, ThrottledPeriodsAreCounted) {
  fs::create_directories(folder.path / "job");
  folder.write("cpu.stat", "usage_usec 7\nnr_periods 9\nnr_throttled 3\nthrottled_usec 4\n");
  folder.write("job/cpu.stat", "nr_throttled 2\n");
  EXPECT_EQ(throttled_periods(folder.path, "0::/job\n"), 5u);
  EXPECT_EQ(throttled_periods(folder.path, "0::/\n"), 3u);
  EXPECT_EQ(throttled_periods(folder.path / "none", "0::/job\n"), 0u);
}

TEST(InterruptedRow, SaysWhatKeptTheProcessFromRunning) {
  Row row;
  row.case_name = "torus";
  add_interruptions(row, {5, 1, 7}, {5, 1, 7.01});
  EXPECT_TRUE(row.provenance.empty());
  EXPECT_EQ(interruption_warning(row), "");
  add_interruptions(row, {5, 1, 7}, {12, 2, 67});
  expect_has(interruption_warning(row), {"torus: ", "quota of CPU time was used up 7 times",
                                         "a signal stopped it 1 times", "slept for 60.0 s"});
}

}  // namespace
}  // namespace pelage
