// Tests that `pelage run` warns if other processes use much of the machine's CPU time while a case is timed.
#include <gtest/gtest.h>

#include "tests/cli/shell.hpp"
#include "tests/support/busy.hpp"

namespace pelage::cli {
namespace {

TEST(Load, OfOtherProcessesIsWarnedOfAndRecorded) {
  if (!std::ifstream("/proc/stat")) GTEST_SKIP() << "no /proc/stat";
  const Folder folder;
  folder.write("one.toml",
               "name = 'one'\ntitle = 'one'\n[axes]\nmodel = ['torus']\nlayers = [4]\nsize = ['320x240']\n"
               "[scene]\nfur.texture = 64\n"
               "[preset.quick]\nwarm_up_s = 1.0\nleast = 2\nmost = 2\nprecision = 1.0\nlimit_s = 5.0\n");
  const test::BusyMachine busy;
  const Outcome run = pelage(folder, "run one.toml -o out; cat out/one/*.jsonl >rows");
  EXPECT_NE(run.err.find("pelage: warning: torus-4-320x240: other processes took "), std::string::npos)
      << run.err;
  const std::string rows = folder.read("rows");
  EXPECT_NE(rows.find("\"other_cpu_share\":0."), std::string::npos) << rows;
  EXPECT_NE(rows.find("\"cpu_ms\":["), std::string::npos) << rows;
}

}  // namespace
}  // namespace pelage::cli
