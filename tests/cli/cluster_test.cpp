// Tests `pelage merge`, the options --shard and --balance, the scripts in experiments/slurm with a real
// Slurm, and the commands in docs/machines.md.
#include <algorithm>
#include <regex>

#include "tests/cli/document.hpp"

namespace pelage::cli {
namespace {

struct Cluster : InFolder {
  void SetUp() override { folder.write("own.toml", of_torus("layers = [4, 6, 8, 10]")); }
  void run(const std::string& options) const { done("run own.toml --host nodes " + options); }
};

/// Returns the sorted names of cases in the lines of `text` that contain `part`.
std::vector<std::string> cases_of(const std::string& text, const std::string& part = "") {
  static const std::regex name("torus_24x12-[0-9]+-320x240");
  std::vector<std::string> names;
  std::smatch match;
  for (const std::string& line : test::lines_of(text))
    if (has(line, part) && std::regex_search(line, match, name)) names.push_back(match.str());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> cases_in(const Folder& folder, const std::string& results) {
  return cases_of(pelage(folder, "export " + results).out, ",frame,wall,");
}

TEST_F(Cluster, MergedShardsAreTheRunAndNamedIfMissing) {
  run("-o single");
  run("--shard 0/2 -o s0");
  const Outcome half = pelage("merge half s0 --expect own.toml");
  EXPECT_EQ(half.code, 4) << half.err;
  expect_has(half.out, {"\tshard 1/2: no rows\n", "\tcase torus_24x12-6-320x240: no row\n"});
  EXPECT_EQ(test::lines_of(half.out).size(), 3u) << half.out;

  run("--shard 1/2 -o s1");
  const Outcome whole = done("merge whole half s1 s0 --expect own.toml");
  EXPECT_EQ(whole.out, "");
  expect_has(whole.err, "whole: 4 rows, 4 pictures; 2 copies of rows left out");
  EXPECT_EQ(cases_in(folder, "whole").size(), 4u);
  EXPECT_EQ(cases_in(folder, "whole"), cases_in(folder, "single"));
  EXPECT_TRUE(fs::exists(folder.path / "whole/own/images/torus_24x12-8-320x240.png"));

  expect_has(done("run own.toml --host nodes --resume whole").err, "4 kept");
  done("report whole -o page");
  done("merge --dry-run none whole");
  EXPECT_FALSE(fs::exists(folder.path / "none"));
}

TEST_F(Cluster, ARunCutByItsBudgetIsIncomplete) {
  done("run own.toml --budget 0.000001s -o cut");
  EXPECT_EQ(pelage("merge out cut").code, 2);  // the results contain no row
  run("--filter x12-4- -o cut4");
  run("--resume cut4 --budget 0.000001s");
  // The filter limited this run to one case, so no case is missing.
  done("merge --dry-run out cut4");
  const Outcome cases = pelage("merge --dry-run out cut4 --expect own.toml");
  EXPECT_EQ(cases.code, 4);
  EXPECT_EQ(test::lines_of(cases.out).size(), 3u) << cases.out;
}

TEST_F(Cluster, BalancedShardsAreAPartition) {
  run("-o earlier");
  std::string cases;
  for (const char* shard : {"0/3", "1/3", "2/3"}) {
    const Outcome one = done(std::string("run own.toml --dry-run --balance earlier --shard ") + shard);
    expect_has(one.err, " of 4 cases; earlier rows took ");
    cases += one.out;
  }
  EXPECT_EQ(cases_of(cases).size(), 4u);
  EXPECT_EQ(cases_of(cases), cases_in(folder, "earlier"));
}

TEST_F(Cluster, ADivisionThatChangesIsRefused) {
  run("-o earlier --filter x12-4-");
  run("-o s0 --shard 0/2");
  expect_refused(pelage("run own.toml --host nodes --shard 0/2 --filter x12-8- --resume s0"),
                 "other cases or another --balance");
  for (const char* options : {"--shard 0/2 --balance s0 --resume s0", "--shard 0/2 --balance . -o new",
                              "--balance earlier -o new", "--shard 0/2 --balance nowhere -o new"})
    expect_refused(pelage(std::string("run own.toml ") + options), "");
}

TEST_F(Cluster, MergeRefusesWhatItCannotJoin) {
  run("-o a --filter x12-4-");
  run("-o b --filter x12-4-");
  expect_refused(pelage("merge out a b"), "measured in different runs");
  EXPECT_FALSE(fs::exists(folder.path / "out"));
  expect_has(done("merge out a b --keep-apart").err, "rows that differ (run) are in out/apart-2");
  folder.write("file", "text");
  const std::string in_source = std::string(PELAGE_SOURCE_DIR) + "/results/new a";
  for (const std::string& arguments : std::initializer_list<std::string>{
           "a", "a b", "out2", "out2 nowhere", "file a", "out2 a --preset quick",
           "out2 a --expect nowhere.toml", "out2 a --expect own.toml --filter zz", in_source})
    expect_refused(pelage("merge " + arguments), "");
  EXPECT_EQ(folder.read("file"), "text");
}

TEST_F(Cluster, AnAnonymousRunKeepsTheGivenHostOnly) {
  run("--anonymous -o a --filter x12-4-");
  const std::string journal = journal_in(folder, "a"), text = folder.read(journal);
  EXPECT_TRUE(journal.ends_with("@nodes.jsonl")) << journal;
  expect_has(text, "\"host\":\"nodes\"");
  expect_lacks(text, "\"node\"");
}

constexpr int not_installed = 77;

/// The variable PELAGE names the pelage program of this build.
struct Slurm : InFolder {
  int run(const std::string& command) const {
    return shell("PELAGE='" PELAGE_BINARY "' timeout 1200 " + command);
  }
};

TEST_F(Slurm, KilledAndLostShardsMergeToTheRowsOfOneRun) {
  const int code = run("'" PELAGE_SOURCE_DIR "/scripts/slurm_check.sh' work");
  if (code == not_installed) GTEST_SKIP() << "Slurm is not installed (packages: .ci/packages.txt)";
  EXPECT_EQ(code, 0) << folder.read("stdout") << folder.read("stderr");
  expect_has(folder.read("stdout"), "slurm_check: passed");
}

// The test runs only the code blocks of docs/machines.md that begin with ```sh. The commands in the other
// code blocks configure a new build, or need a container or several machines.
TEST_F(Slurm, EveryShellBlockOfTheDocumentWorks) {
  if (shell("sh -c 'command -v sbatch && command -v parallel'") != 0)
    GTEST_SKIP() << "Slurm or GNU parallel is not installed (packages: .ci/packages.txt)";
  std::string blocks;
  for (const Block& block : blocks_of(PELAGE_SOURCE_DIR "/docs/machines.md"))
    if (block.language == "sh") blocks += block.text;
  ASSERT_GT(std::count(blocks.begin(), blocks.end(), '\n'), 8);
  const std::string build = fs::path(PELAGE_BINARY).lexically_normal().parent_path().string();
  // The document installs pelage to $HOME/pelage, so HOME is set to the temporary folder. XDG_CACHE_HOME
  // still names the user's cache folder, so that pelage finds the prepared meshes there.
  folder.write("blocks.sh",
               "set -euxo pipefail\nexport XDG_CACHE_HOME=${XDG_CACHE_HOME:-$HOME/.cache} HOME=$PWD\n"
               "unset PELAGE\ncmake --install '" +
                   build + "' --prefix \"$HOME/pelage\" >/dev/null\n" + blocks);
  const int code = run("'" PELAGE_SOURCE_DIR "/scripts/slurm_here.sh' slurm-node bash \"$PWD/blocks.sh\"");
  EXPECT_EQ(code, 0) << folder.read("stdout") << folder.read("stderr");
  EXPECT_TRUE(fs::exists(folder.path / "report/index.html"));
}

}  // namespace
}  // namespace pelage::cli
