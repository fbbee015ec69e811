// A mutant is a deliberate mistake: it replaces a text of the sources by a wrong text. .ci/full applies the
// mutants of tests/mutants and runs the tests that must detect them. The tests in this file check that the
// text that a mutant replaces occurs exactly once in the sources.
#include <fmt/format.h>

#include "tests/house/rules.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace fs = std::filesystem;
using pelage::house::root;

namespace {

int checked(const fs::path& data) {
  return std::system(
      fmt::format("'{}' --check --data '{}' >&2", (root / "scripts/mutants.py").string(), data.string())
          .c_str());
}

TEST(MutantFiles, CanBeApplied) {
  if (!fs::exists(root / ".git")) GTEST_SKIP() << "mutants.py asks git for the sources";
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(root / "tests/mutants")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    EXPECT_EQ(checked(entry.path()), 0) << entry.path();
  }
  EXPECT_GE(files, 3u);
}

TEST(MutantFiles, AreAllRunByCi) {
  const std::string text = pelage::test::text_of(root / ".ci/full");
  pelage::test::expect_has(
      text, "for data in tests/mutants/*.toml; do\n  scripts/mutants.py --data \"$data\"\ndone\n");
}

TEST(MutantFiles, APlantedTextThatIsGoneIsSeen) {
  if (!fs::exists(root / ".git")) GTEST_SKIP() << "mutants.py asks git for the sources";
  const pelage::test::Folder folder;
  folder.write("gone.toml", "[test_house.'*'.gone]\nwhy = ''\noriginal = 'no such text'\nreplacement = ''\n");
  EXPECT_NE(checked(folder.path / "gone.toml"), 0);
}

}  // namespace
