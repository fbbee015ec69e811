// Tests that the paths in docs/code.md exist, and that docs/code.md names every folder that contains code.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Returns the paths of this repository that `document` names in backticks.
std::set<std::string> paths_of(const std::string& document) {
  static const std::regex quoted(
      "`((harness|kernels|shaders|tests|docs|experiments|examples|results)/[^`*]*)`");
  std::set<std::string> paths;
  for (std::sregex_iterator match(document.begin(), document.end(), quoted), end; match != end; ++match)
    paths.insert((*match)[1]);
  return paths;
}

}  // namespace

TEST(Map, NamesPathsThatExist) {
  const fs::path root = PELAGE_SOURCE_DIR;
  const std::set<std::string> paths = paths_of(text_of(root / "docs/code.md"));
  EXPECT_GT(paths.size(), 50u);
  for (const std::string& path : paths) EXPECT_TRUE(fs::exists(root / path)) << path;
}

TEST(Map, NamesEveryFolderWithCode) {
  const fs::path root = PELAGE_SOURCE_DIR;
  const std::string document = text_of(root / "docs/code.md");
  for (const char* top : {"harness", "kernels"})
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (!entry.is_directory()) continue;
      bool code = false;
      for (const auto& file : fs::directory_iterator(entry.path()))
        code = code || file.path().extension() == ".hpp" || file.path().extension() == ".cl";
      const std::string path = entry.path().lexically_relative(root).generic_string();
      if (!code) continue;
      EXPECT_NE(document.find(path), std::string::npos) << path;
    }
}

TEST(Map, APlantedPathIsSeen) {
  EXPECT_EQ(paths_of("see `harness/no/such.cpp`, `word`, `tests/CMakeLists.txt` and harness/plain.cpp"),
            (std::set<std::string>{"harness/no/such.cpp", "tests/CMakeLists.txt"}));
}
