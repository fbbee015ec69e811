// Tests that the tables of recorded results in README.md and results/README.md are those of results/tables.
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace fs = std::filesystem;

namespace {

int exit_of_check(const fs::path& tree) {
  return std::system(("python3 '" + (tree / "scripts/recorded_tables.py").string() + "' --check").c_str());
}

void replace_once(const fs::path& file, const std::string& from, const std::string& to) {
  pelage::test::write_text(file, pelage::test::replaced(pelage::test::text_of(file), from, to));
}

}  // namespace

TEST(Figures, OfTheDocumentsAreThoseOfTheRecordedResults) {
  EXPECT_EQ(exit_of_check(PELAGE_SOURCE_DIR), 0);
}

// Changes one number in a copy of a document or of a table, one after another. The check must find each
// change.
TEST(Figures, PlantedMistakesAreFound) {
  const fs::path source = PELAGE_SOURCE_DIR;
  const pelage::test::Folder folder;
  const fs::path& copy = folder.path;
  const auto everything = fs::copy_options::recursive | fs::copy_options::overwrite_existing;
  for (const char* part : {"scripts", "experiments", "results/tables", "results/rival-options"}) {
    fs::create_directories((copy / part).parent_path());
    fs::copy(source / part, copy / part, everything);
  }
  const auto documents = [&] {
    for (const char* file : {"README.md", "results/README.md"})
      fs::copy_file(source / file, copy / file, everything);
  };
  documents();
  EXPECT_EQ(exit_of_check(copy), 0);
  replace_once(copy / "README.md", "| lion, 365118 triangles | 3 |", "| lion, 365118 triangles | 4 |");
  EXPECT_NE(exit_of_check(copy), 0);
  documents();
  replace_once(copy / "results/README.md", "\n| two tori, plain shells | AMD EPYC | 8 |",
               "\n| two tori, plain shells | AMD EPYC | 9 |");
  EXPECT_NE(exit_of_check(copy), 0);
  documents();
  replace_once(copy / "results/tables/table1/silva2010-table1.csv", "\nlion,365118,paper,16,800x600",
               "\nlion,365119,paper,16,800x600");
  EXPECT_NE(exit_of_check(copy), 0);
}
