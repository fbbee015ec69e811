// Tests .ci/lint in a temporary checkout, with a stub in place of clang-tidy. The tests check the order of
// the files, the time limit, and the effect of a finding.
#include <set>
#include <sstream>
#include <vector>

#include "tests/house/checkout.hpp"

namespace pelage::house {
namespace {

struct Lint : Checkout {
  void SetUp() override {
    if (std::system("git --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no git";
    copy_of_repository(".ci/lint");
    for (const char* folder : {"bench", "tests"})
      std::filesystem::create_directories(path(std::string("checkout/") + folder));
    for (char c = 'a'; c <= 'j'; ++c) write(fmt::format("checkout/harness/{}.cpp", c), "");
    clang_tidy("exit 0");
    ASSERT_EQ(shell("git init -q -b main && git add . && git commit -q -m first"), 0);
    for (int i = 0; i < 10; ++i) ASSERT_EQ(shell("git commit -q --allow-empty -m next"), 0);
  }
  // Installs a stub of clang-tidy, which records the name of its source file and runs the shell code `body`.
  // With one processor (the stub of nproc), .ci/lint checks the files in their order.
  void clang_tidy(const std::string& body) const {
    stub("clang-tidy",
         fmt::format("for file; do :; done\necho \"$file\" >>'{}'\n{}", path("notes").string(), body));
    stub("nproc", "echo 1");
    stub("cmake", "");
  }
  std::string output() const { return read("output"); }
  std::vector<std::string> linted() const {
    std::istringstream stream(read("notes"));
    return {std::istream_iterator<std::string>(stream), {}};
  }
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
  expect_has(output(), "linted 10 of 10 files, 3 of 3 changed ones");
}

TEST_F(Lint, StartsNothingAfterItsLimit) {
  EXPECT_EQ(shell("PELAGE_LINT_MINUTES=0 .ci/lint"), 0) << output();
  EXPECT_TRUE(linted().empty());
  expect_has(output(), "linted 0 of 10 files");
  EXPECT_EQ(shell("PELAGE_LINT_MINUTES=all .ci/lint"), 0) << output();
  EXPECT_EQ(linted().size(), 10u);
  EXPECT_EQ(shell("PELAGE_LINT_MINUTES=soon .ci/lint"), 2);
}

TEST_F(Lint, OneFindingFailsAndTheOthersAreStillLinted) {
  clang_tidy("test \"$file\" != harness/e.cpp");
  EXPECT_NE(shell(".ci/lint"), 0);
  EXPECT_EQ(linted().size(), 10u);
  expect_has(output(), "lint: harness/e.cpp has findings");
}

TEST_F(Lint, WorksWithoutGit) {
  std::filesystem::remove_all(path("checkout/.git"));
  EXPECT_EQ(shell("GIT_CEILING_DIRECTORIES=.. .ci/lint"), 0) << output();
  EXPECT_EQ(linted().size(), 10u);
}

// A run with a time limit may check only some of the unchanged files, so each commit makes .ci/lint start at
// another one.
TEST_F(Lint, TheOrderOfUnchangedFilesMovesOn) {
  for (int i = 0; i < 50; ++i) write(fmt::format("checkout/tests/{}.cpp", i), "");
  ASSERT_EQ(shell("git add . && git commit -q -m more"), 0);
  std::set<std::string> first;
  for (int run = 0; run < 2; ++run) {
    for (int i = 0; i < 10 + run; ++i) ASSERT_EQ(shell("git commit -q --allow-empty -m next"), 0);
    std::filesystem::remove(path("notes"));
    ASSERT_EQ(shell(".ci/lint"), 0) << output();
    first.insert(linted().front());
  }
  EXPECT_EQ(first.size(), 2u);
}

}  // namespace
}  // namespace pelage::house
