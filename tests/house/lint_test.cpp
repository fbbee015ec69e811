// Tests .ci/lint in a temporary checkout, with a stub in place of clang-tidy. The tests check the order of
// the files, the time limit, and the effect of a finding.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

class Lint : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("git --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no git";
    std::string name = (fs::temp_directory_path() / "pelage-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    for (const char* part : {"bin", "checkout/.ci", "checkout/harness", "checkout/bench", "checkout/tests"})
      fs::create_directories(folder_ / part);
    fs::copy_file(fs::path(PELAGE_SOURCE_DIR) / ".ci/lint", folder_ / "checkout/.ci/lint");
    for (char c = 'a'; c <= 'j'; ++c) write(fmt::format("checkout/harness/{}.cpp", c), "");
    clang_tidy("exit 0");
    ASSERT_EQ(shell("git init -q -b main && git add . && git commit -q -m first"), 0);
    for (int i = 0; i < 10; ++i) ASSERT_EQ(shell("git commit -q --allow-empty -m next"), 0);
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file) << text;
  }
  // Installs a stub of clang-tidy. The stub records the name of the source file that it should check, and
  // then runs the shell code `body`. Also installs a stub of nproc that reports one processor, so .ci/lint
  // checks the files one after another. The names are therefore recorded in the order of the checks. A stub
  // of cmake configures nothing.
  void clang_tidy(const std::string& body) const {
    write("bin/clang-tidy", fmt::format("#!/bin/sh\nfor file; do :; done\necho \"$file\" >>'{}'\n{}\n",
                                        notes().string(), body));
    write("bin/nproc", "#!/bin/sh\necho 1\n");
    write("bin/cmake", "#!/bin/sh\n");
    for (const char* tool : {"bin/clang-tidy", "bin/nproc", "bin/cmake"})
      fs::permissions(folder_ / tool, fs::perms::owner_all);
  }
  fs::path notes() const { return folder_ / "notes"; }
  int shell(const std::string& command) const {
    const int status = std::system(
        fmt::format("cd '{}' && export PATH='{}':\"$PATH\" GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a "
                    "GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b && ({}) >'{}' 2>&1",
                    (folder_ / "checkout").string(), (folder_ / "bin").string(), command,
                    (folder_ / "output").string())
            .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string output() const {
    std::ifstream stream(folder_ / "output");
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  // Returns the files that the stub of clang-tidy received, in order.
  std::vector<std::string> linted() const {
    std::ifstream stream(notes());
    return {std::istream_iterator<std::string>(stream), {}};
  }
  fs::path folder_;
};

TEST_F(Lint, TakesChangedFilesFirstAndThenAllOthersOnce) {
  write("checkout/harness/h.cpp", "int h;\n");
  write("checkout/harness/c.hpp", "int c();\n");  // if this header changes, c.cpp is linted
  ASSERT_EQ(shell("git add . && git commit -q -m change"), 0);
  write("checkout/harness/f.cpp", "int f;\n");  // a file that is not yet committed
  ASSERT_EQ(shell(".ci/lint"), 0) << output();
  const std::vector<std::string> files = linted();
  ASSERT_EQ(files.size(), 10u);
  EXPECT_EQ(std::set(files.begin(), files.end()).size(), 10u);
  EXPECT_EQ(std::vector(files.begin(), files.begin() + 3),
            (std::vector<std::string>{"harness/c.cpp", "harness/f.cpp", "harness/h.cpp"}));
  EXPECT_NE(output().find("linted 10 of 10 files, 3 of 3 changed ones"), std::string::npos) << output();
}

TEST_F(Lint, StartsNothingAfterItsLimit) {
  EXPECT_EQ(shell("PELAGE_LINT_MINUTES=0 .ci/lint"), 0) << output();
  EXPECT_TRUE(linted().empty());
  EXPECT_NE(output().find("linted 0 of 10 files"), std::string::npos) << output();
  EXPECT_EQ(shell("PELAGE_LINT_MINUTES=all .ci/lint"), 0) << output();
  EXPECT_EQ(linted().size(), 10u);
  EXPECT_EQ(shell("PELAGE_LINT_MINUTES=soon .ci/lint"), 2);
}

TEST_F(Lint, OneFindingFailsAndTheOthersAreStillLinted) {
  clang_tidy("test \"$file\" != harness/e.cpp");
  EXPECT_NE(shell(".ci/lint"), 0);
  EXPECT_EQ(linted().size(), 10u);
  EXPECT_NE(output().find("lint: harness/e.cpp has findings"), std::string::npos) << output();
}

TEST_F(Lint, WorksWithoutGit) {
  fs::remove_all(folder_ / "checkout/.git");
  EXPECT_EQ(shell("GIT_CEILING_DIRECTORIES=.. .ci/lint"), 0) << output();
  EXPECT_EQ(linted().size(), 10u);
}

// A run of .ci/lint with a time limit may check only some of the unchanged files. After each commit, .ci/lint
// therefore starts at another file of the list of unchanged files. After enough commits, the runs have
// checked every file.
TEST_F(Lint, TheOrderOfUnchangedFilesMovesOn) {
  for (int i = 0; i < 50; ++i) write(fmt::format("checkout/tests/{}.cpp", i), "");
  ASSERT_EQ(shell("git add . && git commit -q -m more"), 0);
  std::set<std::string> first;
  for (int run = 0; run < 2; ++run) {
    for (int i = 0; i < 10 + run; ++i) ASSERT_EQ(shell("git commit -q --allow-empty -m next"), 0);
    fs::remove(notes());
    ASSERT_EQ(shell(".ci/lint"), 0) << output();
    first.insert(linted().front());
  }
  EXPECT_EQ(first.size(), 2u);
}

}  // namespace
