// Tests bootstrap.sh with stub commands in place of apt, cmake, ctest and pelage. The tests check which
// commands the script calls, and how it reacts to their results.
#include <unistd.h>

#include <array>

#include "tests/house/checkout.hpp"

namespace pelage::house {
namespace {

struct Outcome {
  int exit_code;
  std::string text;   // stdout and stderr
  std::string calls;  // one line per call of a stub
};

struct Bootstrap : Checkout {
  void SetUp() override {
    copy_of_repository("bootstrap.sh");
    copy_of_repository("experiments/silva2010-table1.toml");
    write("checkout/packages.txt", "cmake\n# a comment\nlibexample-dev   # its reason\n");
    write("checkout/build/release/build.ninja", "");
    write("checkout/build/release/CMakeCache.txt",
          fmt::format("CMAKE_HOME_DIRECTORY:INTERNAL={}\n", path("checkout").string()));
    // By default, the stub of dpkg-query reports every package as installed, and all other stubs succeed. A
    // test that needs another behaviour of a program overwrites the stub of this program.
    stub("dpkg-query", "echo -n installed");
    for (const char* tool : {"apt-get", "cmake", "ctest", "sudo"}) stub(tool, log_of(tool));
    write_program(binary, log_of("pelage"));
  }
  std::string log_of(const std::string& tool) const {
    return fmt::format("echo {} \"$@\" >>'{}'", tool, path("calls").string());
  }
  Outcome run(const std::string& arguments) const {
    std::filesystem::remove(path("calls"));
    const int code = shell("./bootstrap.sh " + arguments);
    return {code, read("output"), read("calls")};
  }
  const std::string binary = "checkout/build/release/pelage";
};

TEST_F(Bootstrap, ExplainsItself) {
  EXPECT_EQ(run("").exit_code, 0);
  expect_has(run("--help").text, "table1");
  const Outcome wrong = run("tabel1");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.calls, "");
}

TEST_F(Bootstrap, InstallsNothingThatIsThere) {
  const Outcome outcome = run("--no-install build");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  expect_lacks(outcome.calls, "apt-get");
  expect_has(outcome.calls, "--target pelage");
}

TEST_F(Bootstrap, ListsWhatIsMissingAndTouchesNothing) {
  stub("dpkg-query", "case $* in *libexample*) exit 1;; *) echo -n installed;; esac");
  const Outcome outcome = run("--no-install table1");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.text;
  expect_has(outcome.text, "apt-get install --no-install-recommends libexample-dev\n");
  EXPECT_EQ(outcome.calls, "");
}

TEST_F(Bootstrap, InstallsWhatIsMissingOnly) {
  stub("dpkg-query", "case $* in *libexample*) exit 1;; *) echo -n installed;; esac");
  // This stub of sudo executes its arguments as a command, so the stub of apt-get is called.
  stub("sudo", "exec \"$@\"");
  const Outcome outcome = run("setup");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  expect_has(outcome.text, "installing 1 packages");
  expect_has(outcome.calls, {"update\n", "install --no-install-recommends libexample-dev\n"});
  expect_lacks(outcome.calls, "install --no-install-recommends cmake");
}

TEST_F(Bootstrap, ShowsWhyAnInstallationFailed) {
  stub("dpkg-query", "exit 1");
  stub("sudo", "exec \"$@\"");
  stub("apt-get", "echo 'E: Unable to locate package libexample-dev'; exit 100");
  const Outcome outcome = run("build");
  EXPECT_EQ(outcome.exit_code, 1);
  expect_has(outcome.text, "Unable to locate package libexample-dev");
  EXPECT_FALSE(has(outcome.calls, "cmake")) << "went on to build";
}

TEST_F(Bootstrap, RunsTableOneIntoAFolderOfItsOwnAndReportsIt) {
  const Outcome outcome = run("table1 --device pocl");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  expect_has(outcome.calls, {"pelage mesh lion\n", "pelage mesh torus\n",
                             "pelage run silva2010-table1 --preset quick -o pelage-results/",
                             "--device pocl\n", "pelage report pelage-results/"});
  expect_has(outcome.text, "report/index.html");
}

TEST_F(Bootstrap, LeavesTheUsersOwnChoicesAlone) {
  const Outcome chosen = run("table1 --preset smoke -o mine");
  expect_lacks(run("table1 --filter torus").calls, "pelage mesh");
  expect_has(chosen.calls,
             {"pelage run silva2010-table1 --preset smoke -o mine\n", "pelage report mine -o mine/report\n"});
  expect_has(run("table1 --resume old").calls, {"pelage run silva2010-table1 --preset quick --resume old\n",
                                                "pelage report old -o old/report\n"});
  expect_lacks(run("table1 --dry-run").calls, "pelage report");
  const Outcome anonymous = run("table1 --anonymous");
  std::array<char, 256> host{};
  ASSERT_EQ(::gethostname(host.data(), host.size() - 1), 0);
  expect_lacks(anonymous.calls, host.data());
}

TEST_F(Bootstrap, RerunsThePapers) {
  const Outcome outcome = run("papers wetfur2010 --preset smoke -o mine");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  expect_has(outcome.calls, "pelage reproduce wetfur2010 --preset smoke -o mine\n");
}

TEST_F(Bootstrap, PassesOnHowTheRunEnded) {
  for (const int code : {1, 2, 3, 130}) {
    write_program(binary, log_of("pelage") + fmt::format("\ncase $1 in run) exit {};; esac", code));
    const Outcome outcome = run("table1 -o mine");
    EXPECT_EQ(outcome.exit_code, code);
    EXPECT_EQ(has(outcome.calls, "pelage report"), code == 1)
        << "a run whose checks failed is reported, " << code;
    EXPECT_EQ(has(outcome.text, "table1 --resume mine"), code == 130);
  }
}

TEST_F(Bootstrap, RunsTheTestsAndPassesOnTheirVerdict) {
  stub("nproc", "echo 5");
  const Outcome passed = run("test -R cl");
  EXPECT_EQ(passed.exit_code, 0) << passed.text;
  expect_has(passed.calls, "--output-on-failure --parallel 5 --label-exclude full -R cl\n");
  expect_has(run("test --full -R cl").calls, "--output-on-failure --parallel 5 -R cl\n");
  stub("ctest", "exit 8");
  EXPECT_EQ(run("test").exit_code, 8);
}

TEST_F(Bootstrap, BuildsAnewInAFolderThatCameFromElsewhere) {
  write("checkout/build/release/CMakeCache.txt", "CMAKE_HOME_DIRECTORY:INTERNAL=elsewhere\n");
  const Outcome outcome = run("build");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  expect_has(outcome.calls, "cmake --preset release");
  expect_has(outcome.text, "another checkout");
}

}  // namespace
}  // namespace pelage::house
