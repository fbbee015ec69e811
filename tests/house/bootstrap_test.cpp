// Tests bootstrap.sh with stub commands in place of apt, cmake, ctest and pelage. The tests check which
// commands the script calls, and how it reacts to their results.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace fs = std::filesystem;

namespace {

struct Outcome {
  int exit_code;
  std::string text;   // stdout and stderr
  std::string calls;  // one line per call of a stub
};

class Bootstrap : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "pelage-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    fs::create_directories(folder_ / "bin");
    fs::create_directories(folder_ / "checkout/build/release");
    fs::copy_file(fs::path(PELAGE_SOURCE_DIR) / "bootstrap.sh", checkout() / "bootstrap.sh");
    write(checkout() / "packages.txt", "cmake\n# a comment\nlibexample-dev   # its reason\n");
    write(checkout() / "build/release/build.ninja", "");
    write(checkout() / "build/release/CMakeCache.txt",
          fmt::format("CMAKE_HOME_DIRECTORY:INTERNAL={}\n", checkout().string()));
    // By default, the stub of dpkg-query reports every package as installed, and all other stubs succeed. A
    // test that needs another behaviour of a program overwrites the stub of this program.
    stub(folder_ / "bin/dpkg-query", "echo -n installed");
    for (const char* tool : {"apt-get", "cmake", "ctest", "sudo"}) stub(folder_ / "bin" / tool, log_of(tool));
    stub(pelage(), log_of("pelage"));
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path checkout() const { return folder_ / "checkout"; }
  fs::path pelage() const { return checkout() / "build/release/pelage"; }
  std::string log_of(const std::string& tool) const {
    return fmt::format("echo {} \"$@\" >>'{}'", tool, (folder_ / "calls").string());
  }
  static void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
  static void stub(const fs::path& file, const std::string& body) {
    write(file, "#!/bin/sh\n" + body + "\n");
    fs::permissions(file, fs::perms::owner_all);
  }
  Outcome run(const std::string& arguments) const {
    fs::remove(folder_ / "calls");
    const std::string command = fmt::format("cd '{}' && PATH='{}':\"$PATH\" ./bootstrap.sh {} 2>&1",
                                            checkout().string(), (folder_ / "bin").string(), arguments);
    Outcome outcome{};
    FILE* pipe = ::popen(command.c_str(), "r");
    std::array<char, 4096> part;
    while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe))
      outcome.text.append(part.data(), n);
    const int status = ::pclose(pipe);
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    std::ifstream calls(folder_ / "calls");
    outcome.calls = {std::istreambuf_iterator<char>(calls), {}};
    return outcome;
  }

  fs::path folder_;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_F(Bootstrap, ExplainsItself) {
  EXPECT_EQ(run("").exit_code, 0);
  EXPECT_TRUE(has(run("--help").text, "table1"));
  const Outcome wrong = run("tabel1");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.calls, "");
}

TEST_F(Bootstrap, InstallsNothingThatIsThere) {
  const Outcome outcome = run("--no-install build");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_FALSE(has(outcome.calls, "apt-get")) << outcome.calls;
  EXPECT_TRUE(has(outcome.calls, "--target pelage")) << outcome.calls;
}

TEST_F(Bootstrap, ListsWhatIsMissingAndTouchesNothing) {
  stub(folder_ / "bin/dpkg-query", "case $* in *libexample*) exit 1;; *) echo -n installed;; esac");
  const Outcome outcome = run("--no-install table1");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.text;
  EXPECT_TRUE(has(outcome.text, "apt-get install --no-install-recommends libexample-dev\n")) << outcome.text;
  EXPECT_EQ(outcome.calls, "");
}

TEST_F(Bootstrap, InstallsWhatIsMissingOnly) {
  stub(folder_ / "bin/dpkg-query", "case $* in *libexample*) exit 1;; *) echo -n installed;; esac");
  // This stub of sudo executes its arguments as a command, so the stub of apt-get is called.
  stub(folder_ / "bin/sudo", "exec \"$@\"");
  const Outcome outcome = run("setup");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_TRUE(has(outcome.text, "installing 1 packages")) << outcome.text;
  EXPECT_TRUE(has(outcome.calls, "update\n")) << outcome.calls;
  EXPECT_TRUE(has(outcome.calls, "install --no-install-recommends libexample-dev\n")) << outcome.calls;
  EXPECT_FALSE(has(outcome.calls, "install --no-install-recommends cmake")) << outcome.calls;
}

TEST_F(Bootstrap, ShowsWhyAnInstallationFailed) {
  stub(folder_ / "bin/dpkg-query", "exit 1");
  stub(folder_ / "bin/sudo", "exec \"$@\"");
  stub(folder_ / "bin/apt-get", "echo 'E: Unable to locate package libexample-dev'; exit 100");
  const Outcome outcome = run("build");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(has(outcome.text, "Unable to locate package libexample-dev")) << outcome.text;
  EXPECT_FALSE(has(outcome.calls, "cmake")) << "went on to build";
}

TEST_F(Bootstrap, RunsTableOneIntoAFolderOfItsOwnAndReportsIt) {
  const Outcome outcome = run("table1 --device pocl");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_TRUE(has(outcome.calls, "pelage run silva2010-table1 --preset quick -o pelage-results/"))
      << outcome.calls;
  EXPECT_TRUE(has(outcome.calls, "--device pocl\n")) << outcome.calls;
  EXPECT_TRUE(has(outcome.calls, "pelage report pelage-results/")) << outcome.calls;
  EXPECT_TRUE(has(outcome.text, "report/index.html")) << outcome.text;
}

TEST_F(Bootstrap, LeavesTheUsersOwnChoicesAlone) {
  const Outcome chosen = run("table1 --preset smoke -o mine");
  EXPECT_TRUE(has(chosen.calls, "pelage run silva2010-table1 --preset smoke -o mine\n")) << chosen.calls;
  EXPECT_TRUE(has(chosen.calls, "pelage report mine -o mine/report\n")) << chosen.calls;
  const Outcome resumed = run("table1 --resume old");
  EXPECT_TRUE(has(resumed.calls, "pelage run silva2010-table1 --preset quick --resume old\n"))
      << resumed.calls;
  EXPECT_TRUE(has(resumed.calls, "pelage report old -o old/report\n")) << resumed.calls;
  const Outcome dry = run("table1 --dry-run");
  EXPECT_FALSE(has(dry.calls, "pelage report")) << dry.calls;
  const Outcome anonymous = run("table1 --anonymous");
  std::array<char, 256> host{};
  ASSERT_EQ(::gethostname(host.data(), host.size() - 1), 0);
  EXPECT_FALSE(has(anonymous.calls, host.data())) << anonymous.calls;
}

TEST_F(Bootstrap, PassesOnHowTheRunEnded) {
  for (const int code : {1, 2, 3, 130}) {
    stub(pelage(), log_of("pelage") + fmt::format("\ncase $1 in run) exit {};; esac", code));
    const Outcome outcome = run("table1 -o mine");
    EXPECT_EQ(outcome.exit_code, code);
    EXPECT_EQ(has(outcome.calls, "pelage report"), code == 1)
        << "a run whose checks failed is reported, " << code;
    EXPECT_EQ(has(outcome.text, "table1 --resume mine"), code == 130);
  }
}

TEST_F(Bootstrap, RunsTheTestsAndPassesOnTheirVerdict) {
  stub(folder_ / "bin/nproc", "echo 5");
  const Outcome passed = run("test -R cl");
  EXPECT_EQ(passed.exit_code, 0) << passed.text;
  EXPECT_TRUE(has(passed.calls, "--output-on-failure --parallel 5 --label-exclude full -R cl\n"))
      << passed.calls;
  const Outcome full = run("test --full -R cl");
  EXPECT_TRUE(has(full.calls, "--output-on-failure --parallel 5 -R cl\n")) << full.calls;
  stub(folder_ / "bin/ctest", "exit 8");
  EXPECT_EQ(run("test").exit_code, 8);
}

TEST_F(Bootstrap, BuildsAnewInAFolderThatCameFromElsewhere) {
  write(checkout() / "build/release/CMakeCache.txt", "CMAKE_HOME_DIRECTORY:INTERNAL=elsewhere\n");
  const Outcome outcome = run("build");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_TRUE(has(outcome.calls, "cmake --preset release")) << outcome.calls;
  EXPECT_TRUE(has(outcome.text, "another checkout")) << outcome.text;
}
