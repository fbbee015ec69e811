// Kills, resumes and divides sweeps (runs of all cases of an experiment) with the program and the preset
// `smoke`.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <set>

#include "harness/record/results_folder.hpp"
#include "tests/cli/shell.hpp"

namespace pelage {
namespace {

/// Returns all rows without the values that differ between two runs, such as times, paths and dates.
std::set<std::string> said(const std::string& folder) {
  std::set<std::string> lines;
  for (FoundRow& found : read_results({folder})) {
    Row& row = found.row;
    row.run_id.clear();
    row.build_ms = row.first_launch_ms = 0;
    row.metrics.erase("wet_ms");
    row.metrics.erase("per_mask_ms");
    row.metrics.erase("fragments_per_s");
    row.metrics.erase("simulate_ns_per_segment");
    row.metrics.erase("peak_memory");
    for (auto& [phase, samples] : row.samples) {
      std::fill(samples.wall_ms.begin(), samples.wall_ms.end(), 0.0);
      std::fill(samples.event_ms.begin(), samples.event_ms.end(), 0.0);
      std::fill(samples.cpu_ms.begin(), samples.cpu_ms.end(), 0.0);
    }
    for (const char* key : {"utc", "started_s", "load", "load_after", "cpu_mhz", "cpu_mhz_after",
                            "other_cpu_share", "prepare_s", "sampling_s", "shard", "shard_cases",
                            "shard_deal", "check_s", "argv", "order_seed", "converged"})
      row.provenance.erase(key);
    EXPECT_TRUE(lines.insert(to_line(row)).second) << row.case_name << " stands twice";
  }
  return lines;
}

struct Sweep : ::testing::Test {
  static void SetUpTestSuite() {
    folder = std::make_unique<test::Folder>();
    ASSERT_TRUE(fs::exists(PELAGE_BINARY)) << "the program is not built";
    // The first run compiles kernels and creates textures, so that the later runs find them in the caches.
    ASSERT_EQ(sweep("-o first"), 0) << "the smoke sweep itself failed";
    const auto started = std::chrono::steady_clock::now();
    ASSERT_EQ(sweep("-o whole"), 0) << "the smoke sweep itself failed";
    whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    expected = said((folder->path / "whole").string());
    ASSERT_EQ(expected.size(), 4u);
  }
  static void TearDownTestSuite() { folder.reset(); }
  /// Runs the sweep in `folder`. Kills pelage after `kill_after_s` seconds, or never if this is 0. Returns
  /// the exit code, which is 137 if pelage was killed.
  static int sweep(const std::string& options, double kill_after_s = 0) {
    // With few layers, the picture of the reference is computed soon.
    return cli::shell(
        *folder,
        fmt::format(
            "timeout --foreground -s KILL {} '{}' run silva2010-table1 --preset smoke --axis layers=4,16 {}",
            kill_after_s, PELAGE_BINARY, options));
  }
  static inline std::unique_ptr<test::Folder> folder;
  /// Expects that the rows of `results` are equal to the rows of the undisturbed run `whole`. Prints only
  /// rows that differ, because a row is long.
  static void expect_same(const std::string& results) {
    const std::set<std::string> lines = said((folder->path / results).string());
    EXPECT_EQ(lines.size(), expected.size());
    for (const std::string& line : lines)
      EXPECT_TRUE(expected.contains(line)) << row_from_line(line).case_name << " is another row: " << line;
  }
  /// Kills sweeps at `wanted` random moments in all, and expects that each sweep ends with the rows of
  /// `whole`. Each run resumes the run before it, and the last run of a sweep is not killed.
  static void kill_and_resume(int wanted) {
    std::mt19937_64 random(1123);
    int kills = 0, sweeps = 0;
    while (kills < wanted) {
      const std::string out = fmt::format("killed{}-{}", wanted, sweeps++);
      fs::create_directories(folder->path / out);
      for (int i = 0; i < 10 && kills < wanted; ++i)
        kills += sweep("--resume " + out, 0.4 * whole_s * double(random() % 1000) / 1000) == 137;
      ASSERT_EQ(sweep("--resume " + out), 0);
      expect_same(out);
      ASSERT_LT(sweeps, 20) << "the sweep ends before it can be killed";
    }
  }
  static inline double whole_s = 0;
  static inline std::set<std::string> expected;
};

TEST_F(Sweep, KilledAtFourMomentsAndResumedGivesTheSameRows) {
  kill_and_resume(4);
}

TEST_F(Sweep, KilledAtTwentyMomentsAndResumedGivesTheSameRows) {
  kill_and_resume(20);
}

TEST_F(Sweep, ShardsRepeatsAndRefusals) {
  for (const std::string shard : {"0/3", "1/3", "2/3"}) ASSERT_EQ(sweep("-o shards --shard " + shard), 0);
  expect_same("shards");
  EXPECT_EQ(test::files_below(folder->path / "shards", "-of-3.jsonl").size(), 3u);

  // Without --resume, pelage must refuse a folder that already contains rows. With --resume, pelage must keep
  // these rows.
  EXPECT_EQ(sweep("-o whole"), 2);
  expect_same("whole");
  EXPECT_EQ(sweep("--resume whole"), 0);
  expect_same("whole");
  EXPECT_EQ(cli::pelage(*folder, "run silva2010-table1 --preset quick --resume whole").code, 2);

  ASSERT_EQ(sweep("-o repeats --repeat 2 --filter torus-16"), 0);
  std::set<std::string> runs;
  std::set<int> repeats;
  for (const FoundRow& found : read_results({(folder->path / "repeats").string()})) {
    runs.insert(found.row.run_id);
    repeats.insert(found.row.repeat);
  }
  EXPECT_EQ(runs.size(), 2u);
  EXPECT_EQ(repeats, (std::set<int>{0, 1}));
}

TEST(SweepUsage, BadUsageIsExitTwoAndLeavesNothing) {
  const test::Folder folder;
  for (const std::string rest :
       {"no-such-table --preset smoke", "silva2010-table1 --preset fast", "silva2010-table1 --filter '('",
        "silva2010-table1 --filter whale", "silva2010-table1 --shard 2/2",
        "silva2010-table1 --set fur.lenght=1", "silva2010-table1 --set fur.length",
        "silva2010-table1 --axis layers=0", "silva2010-table1 --axis size=0x0",
        "silva2010-table1 --budget soon", "silva2010-table1 --budget '5 weeks'",
        "silva2010-table1 --budget -5s", "silva2010-table1 --budget 1.2.3s", "silva2010-table1 --budget ''",
        "silva2010-table1 --device 'no such device'", "silva2010-table1 --tuning /no/such/file",
        "silva2010-table1 --model /no/such/mesh.obj", "silva2010-table1 silva2010-table1", ""}) {
    const std::string preset = rest.find("--preset") == std::string::npos ? "--preset smoke " : "";
    EXPECT_EQ(cli::pelage(folder, fmt::format("run -o out {}{}", preset, rest)).code, 2) << rest;
    EXPECT_FALSE(fs::exists(folder.path / "out")) << rest;
  }
  for (const std::string time : {"90", "90s", "5m", "1.5h", "0", "123456789.123456789h"})
    cli::done(folder, "run silva2010-table1 --dry-run --budget " + time);
  for (const char* command : {"run silva2010-table1 -o out --resume out", "run silva2010-table1 --resume out",
                              "export out", "report out -o out", "compare out out"})
    EXPECT_EQ(cli::pelage(folder, command).code, 2) << command;
}

}  // namespace
}  // namespace pelage
