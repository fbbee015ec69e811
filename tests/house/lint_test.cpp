// Tests .ci/lint in a temporary checkout, with a stub in place of clang-tidy. The tests check the order of
// the units, the time limit, and the effect of a finding. A file of build/release names the units: most are
// one file here, and one unit has two files.
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
    std::filesystem::create_directories(path("checkout/build/release"));
    write("checkout/.gitignore", "build\n");
    for (char c = 'a'; c <= 'k'; ++c) write(fmt::format("checkout/harness/{}.cpp", c), "");
    for (char c = 'a'; c <= 'i'; ++c) units_.push_back(path(fmt::format("checkout/harness/{}.cpp", c)));
    units_.push_back(path("checkout/build/release/unity_0_cxx.cxx"));
    write(
        "checkout/build/release/unity_0_cxx.cxx",
        fmt::format("#include \"{0}/j.cpp\"\n\n#include \"{0}/k.cpp\"\n", path("checkout/harness").string()));
    write_units();
    clang_tidy("exit 0");
    ASSERT_EQ(shell("git init -q -b main && git add . && git commit -q -m first"), 0);
    for (int i = 0; i < 10; ++i) ASSERT_EQ(shell("git commit -q --allow-empty -m next"), 0);
  }
  // Installs a stub of clang-tidy, which records the name of its unit and runs the shell code `body`.
  // With one processor (the stub of nproc), .ci/lint checks the units in their order.
  void clang_tidy(const std::string& body) const {
    stub("clang-tidy",
         fmt::format("for file; do :; done\necho \"$file\" >>'{}'\n{}", path("notes").string(), body));
    stub("nproc", "echo 1");
    stub("cmake", "");
  }
  void write_units() const {
    std::string text = "[\n";
    for (const std::string& unit : units_) text += fmt::format("{{\n  \"file\": \"{}\"\n}},\n", unit);
    write("checkout/build/release/compile_commands.json", text + "]\n");
  }
  std::string output() const { return read("output"); }
  std::vector<std::string> linted() const {
    std::istringstream stream(read("notes"));
    std::vector<std::string> names;
    for (std::string unit; stream >> unit;) names.push_back(std::filesystem::path(unit).filename());
    return names;
  }
  std::vector<std::string> units_;
};

TEST_F(Lint, TakesUnitsWithChangedFilesFirstAndThenAllOthersOnce) {
  write("checkout/harness/h.cpp", "int h;\n");
  write("checkout/harness/c.hpp", "int c();\n");  // if this header changes, c.cpp is linted
  write("checkout/harness/k.cpp", "int k;\n");
  ASSERT_EQ(shell("git add . && git commit -q -m change"), 0);
  write("checkout/harness/f.cpp", "int f;\n");  // a file that is not yet committed
  ASSERT_EQ(shell(".ci/lint"), 0) << output();
  const std::vector<std::string> units = linted();
  ASSERT_EQ(units.size(), 10u);
  EXPECT_EQ(std::set(units.begin(), units.end()).size(), 10u);
  EXPECT_EQ(std::vector(units.begin(), units.begin() + 4),
            (std::vector<std::string>{"c.cpp", "f.cpp", "h.cpp", "unity_0_cxx.cxx"}));
  expect_has(output(), "linted 10 of 10 units, 4 of 4 with changed files");
}

TEST_F(Lint, StartsNothingAfterItsLimit) {
  EXPECT_EQ(shell("PELAGE_LINT_MINUTES=0 .ci/lint"), 0) << output();
  EXPECT_TRUE(linted().empty());
  expect_has(output(), "linted 0 of 10 units");
  EXPECT_EQ(shell("PELAGE_LINT_MINUTES=all .ci/lint"), 0) << output();
  EXPECT_EQ(linted().size(), 10u);
  EXPECT_EQ(shell("PELAGE_LINT_MINUTES=soon .ci/lint"), 2);
}

TEST_F(Lint, OneFindingFailsAndTheOthersAreStillLinted) {
  clang_tidy("test \"${file##*/}\" != e.cpp");
  EXPECT_NE(shell(".ci/lint"), 0);
  EXPECT_EQ(linted().size(), 10u);
  expect_has(output(), "e.cpp has findings");
}

TEST_F(Lint, WorksWithoutGit) {
  std::filesystem::remove_all(path("checkout/.git"));
  EXPECT_EQ(shell("GIT_CEILING_DIRECTORIES=.. .ci/lint"), 0) << output();
  EXPECT_EQ(linted().size(), 10u);
}

// A run with a time limit may check only some of the unchanged units, so each commit makes .ci/lint start at
// another one.
TEST_F(Lint, TheOrderOfUnchangedUnitsMovesOn) {
  for (int i = 0; i < 50; ++i) units_.push_back(path(fmt::format("checkout/harness/{}.cpp", i)));
  write_units();
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
