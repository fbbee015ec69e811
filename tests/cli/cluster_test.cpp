// Tests `pelage merge`, the options --shard and --balance, the scripts in experiments/slurm with a real
// Slurm, and the commands in docs/machines.md.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

namespace fs = std::filesystem;

/// Writes an experiment with four cases into a temporary folder.
struct Cluster : ::testing::Test {
  void SetUp() override {
    folder.write(
        "own.toml",
        "name = \"own\"\n[axes]\nmodel = [\"torus-24x12\"]\nlayers = [4, 6, 8, 10]\nsize = "
        "[\"320x240\"]\n[scene]\nfur.texture = 64\n[preset.quick]\nwarm_up_s = 0.0\nleast = 2\nmost = "
        "2\nprecision = 1.0\nlimit_s = 20.0\n");
  }
  void run(const std::string& options) const {
    const Outcome outcome = pelage(folder, "run own.toml --host nodes " + options);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  Folder folder;
};

std::size_t lines_of(const std::string& text) {
  return std::size_t(std::count(text.begin(), text.end(), '\n'));
}

/// Returns the sorted names of the cases that `pelage export` prints for `results`.
std::vector<std::string> cases_in(const Folder& folder, const std::string& results) {
  std::istringstream csv(pelage(folder, "export " + results).out);
  std::vector<std::string> names;
  static const std::regex name("torus_24x12-[0-9]+-320x240");
  for (std::string line; std::getline(csv, line);) {
    std::smatch match;
    if (line.find(",frame,wall,") != std::string::npos && std::regex_search(line, match, name))
      names.push_back(match.str());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST_F(Cluster, MergedShardsAreTheRunAndNamedIfMissing) {
  run("-o single");
  run("--shard 0/2 -o s0");
  const Outcome half = pelage(folder, "merge half s0 --expect own.toml");
  EXPECT_EQ(half.code, 4) << half.err;
  EXPECT_NE(half.out.find("\tshard 1/2: no rows\n"), std::string::npos) << half.out;
  EXPECT_NE(half.out.find("\tcase torus_24x12-6-320x240: no row\n"), std::string::npos) << half.out;
  EXPECT_EQ(lines_of(half.out), 3u) << half.out;

  run("--shard 1/2 -o s1");
  const Outcome whole = pelage(folder, "merge whole half s1 s0 --expect own.toml");
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(whole.out, "");
  EXPECT_NE(whole.err.find("whole: 4 rows, 4 pictures; 2 copies of rows left out"), std::string::npos)
      << whole.err;
  EXPECT_EQ(cases_in(folder, "whole").size(), 4u);
  EXPECT_EQ(cases_in(folder, "whole"), cases_in(folder, "single"));
  EXPECT_TRUE(fs::exists(folder.path() / "whole/own/images/torus_24x12-8-320x240.png"));

  const Outcome resumed = pelage(folder, "run own.toml --host nodes --resume whole");
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("4 kept"), std::string::npos) << resumed.err;
  EXPECT_EQ(pelage(folder, "report whole -o page").code, 0);
  const Outcome checked = pelage(folder, "merge --dry-run none whole");
  EXPECT_EQ(checked.code, 0) << checked.out;
  EXPECT_FALSE(fs::exists(folder.path() / "none"));
}

TEST_F(Cluster, ARunCutByItsBudgetIsIncomplete) {
  ASSERT_EQ(pelage(folder, "run own.toml --budget 0.000001s -o cut").code, 0);
  EXPECT_EQ(pelage(folder, "merge out cut").code, 2);  // the results contain no row
  run("--filter x12-4- -o cut4");
  run("--resume cut4 --budget 0.000001s");
  // The filter limited this run to one case, so no case is missing.
  EXPECT_EQ(pelage(folder, "merge --dry-run out cut4").code, 0);
  const Outcome cases = pelage(folder, "merge --dry-run out cut4 --expect own.toml");
  EXPECT_EQ(cases.code, 4);
  EXPECT_EQ(lines_of(cases.out), 3u) << cases.out;
}

TEST_F(Cluster, BalancedShardsAreAPartition) {
  run("-o earlier");
  std::vector<std::string> names;
  for (const char* shard : {"0/3", "1/3", "2/3"}) {
    const Outcome one =
        pelage(folder, std::string("run own.toml --dry-run --balance earlier --shard ") + shard);
    ASSERT_EQ(one.code, 0) << one.err;
    EXPECT_NE(one.err.find(" of 4 cases; earlier rows took "), std::string::npos) << one.err;
    static const std::regex name("torus_24x12-[0-9]+-320x240");
    for (std::sregex_iterator match(one.out.begin(), one.out.end(), name), end; match != end; ++match)
      names.push_back(match->str());
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names.size(), 4u);
  EXPECT_EQ(names, cases_in(folder, "earlier"));
}

TEST_F(Cluster, ADivisionThatChangesIsRefused) {
  run("-o earlier --filter x12-4-");
  run("-o s0 --shard 0/2");
  const Outcome other = pelage(folder, "run own.toml --host nodes --shard 0/2 --filter x12-8- --resume s0");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("other cases or another --balance"), std::string::npos) << other.err;
  for (const char* options : {"--shard 0/2 --balance s0 --resume s0", "--shard 0/2 --balance . -o new",
                              "--balance earlier -o new", "--shard 0/2 --balance nowhere -o new"}) {
    const Outcome outcome = pelage(folder, std::string("run own.toml ") + options);
    EXPECT_EQ(outcome.code, 2) << options << outcome.err;
    EXPECT_EQ(lines_of(outcome.err), 1u) << options << outcome.err;
  }
}

TEST_F(Cluster, MergeRefusesWhatItCannotJoin) {
  run("-o a --filter x12-4-");
  run("-o b --filter x12-4-");
  const Outcome twice = pelage(folder, "merge out a b");
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.err.find("measured in different runs"), std::string::npos) << twice.err;
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
  const Outcome apart = pelage(folder, "merge out a b --keep-apart");
  EXPECT_EQ(apart.code, 0) << apart.err;
  EXPECT_NE(apart.err.find("rows that differ (run) are in out/apart-2"), std::string::npos) << apart.err;
  folder.write("file", "text");
  const std::string in_source = std::string(PELAGE_SOURCE_DIR) + "/results/new a";
  for (const std::string& arguments : std::initializer_list<std::string>{
           "a", "a b", "out2", "out2 nowhere", "file a", "out2 a --preset quick",
           "out2 a --expect nowhere.toml", "out2 a --expect own.toml --filter zz", in_source}) {
    const Outcome outcome = pelage(folder, "merge " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << outcome.err;
    EXPECT_EQ(lines_of(outcome.err), 1u) << arguments << outcome.err;
  }
  EXPECT_EQ(folder.read("file"), "text");
}

TEST_F(Cluster, AnAnonymousRunKeepsTheGivenHostOnly) {
  run("--anonymous -o a --filter x12-4-");
  bool found = false;
  for (const auto& entry : fs::directory_iterator(folder.path() / "a/own"))
    if (entry.path().extension() == ".jsonl") {
      const std::string text = folder.read("a/own/" + entry.path().filename().string());
      EXPECT_NE(entry.path().filename().string().find("@nodes.jsonl"), std::string::npos);
      EXPECT_NE(text.find("\"host\":\"nodes\""), std::string::npos);
      EXPECT_EQ(text.find("\"node\""), std::string::npos);
      found = true;
    }
  EXPECT_TRUE(found);
}

/// Runs a shell command in `folder`. The variable PELAGE names the pelage program of this build. Returns the
/// exit code.
int shell(const Folder& folder, const std::string& command) {
  const std::string line = "cd '" + folder.path().string() +
                           "' && ASAN_OPTIONS=detect_leaks=0 PELAGE='" PELAGE_BINARY "' timeout 1200 " +
                           command + " >stdout 2>stderr";
  const int status = std::system(line.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

constexpr int not_installed = 77;

TEST(Slurm, KilledAndLostShardsMergeToTheRowsOfOneRun) {
  const Folder folder;
  const int code = shell(folder, "'" PELAGE_SOURCE_DIR "/scripts/slurm_check.sh' work");
  if (code == not_installed) GTEST_SKIP() << "Slurm is not installed (packages: .ci/packages.txt)";
  EXPECT_EQ(code, 0) << folder.read("stdout") << folder.read("stderr");
  EXPECT_NE(folder.read("stdout").find("slurm_check: passed"), std::string::npos);
}

/// Returns the text of all code blocks of the document that begin with ```sh.
std::string shell_blocks(const fs::path& document) {
  std::ifstream file(document);
  std::string text;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("```"))
      inside = line == "```sh";
    else if (inside)
      text += line + "\n";
  }
  return text;
}

// The test runs only the code blocks of docs/machines.md that begin with ```sh. The commands in the other
// code blocks configure a new build, or need a container or several machines.
TEST(Slurm, EveryShellBlockOfTheDocumentWorks) {
  const Folder folder;
  if (shell(folder, "sh -c 'command -v sbatch && command -v parallel'") != 0)
    GTEST_SKIP() << "Slurm or GNU parallel is not installed (packages: .ci/packages.txt)";
  const std::string blocks = shell_blocks(PELAGE_SOURCE_DIR "/docs/machines.md");
  ASSERT_GT(std::count(blocks.begin(), blocks.end(), '\n'), 8);
  const std::string build = fs::path(PELAGE_BINARY).lexically_normal().parent_path().string();
  // The document installs pelage to $HOME/pelage, so HOME is set to the temporary folder. XDG_CACHE_HOME
  // still names the user's cache folder, so that pelage finds the prepared meshes there.
  folder.write("blocks.sh",
               "set -euxo pipefail\nexport XDG_CACHE_HOME=${XDG_CACHE_HOME:-$HOME/.cache} HOME=$PWD\n"
               "unset PELAGE\ncmake --install '" +
                   build + "' --prefix \"$HOME/pelage\" >/dev/null\n" + blocks);
  const int code =
      shell(folder, "'" PELAGE_SOURCE_DIR "/scripts/slurm_here.sh' slurm-node bash \"$PWD/blocks.sh\"");
  EXPECT_EQ(code, 0) << folder.read("stdout") << folder.read("stderr");
  EXPECT_TRUE(fs::exists(folder.path() / "report/index.html"));
}

}  // namespace
}  // namespace pelage::cli
