// Tests that the mutants of tests/mutants (scripts/mutants.py) can be applied, and that .ci/full applies
// them.
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
  const std::vector<fs::path> lists = pelage::test::files_below(root / "tests/mutants", ".toml");
  EXPECT_GE(lists.size(), 3u);
  for (const fs::path& list : lists) EXPECT_EQ(checked(list), 0) << list;
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
