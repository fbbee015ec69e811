// Tests that every function `name()` and every file that the documents name in backticks exists.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/house/rules.hpp"
#include "tests/support/files.hpp"

namespace fs = std::filesystem;
using pelage::house::root;

namespace {

std::set<std::string> words_of(const std::string& text) {
  static const std::regex word(R"([A-Za-z_]\w*)");
  std::set<std::string> words;
  for (std::sregex_iterator match(text.begin(), text.end(), word), end; match != end; ++match)
    words.insert(match->str());
  return words;
}

/// The words of the source files and the names of the kernel files. A document may name only functions and
/// kernel files that are in these two sets.
struct Tree {
  std::set<std::string> words;    // all words of the source files
  std::set<std::string> kernels;  // names of the files under kernels/
};

const Tree& tree() {
  static const Tree known = [] {
    Tree made;
    for (const char* folder : {"harness", "kernels", "shaders", "tests", "bench"})
      for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        if (!entry.is_regular_file() || entry.path().filename() == "documents_test.cpp") continue;
        made.words.merge(words_of(pelage::test::text_of(entry.path())));
        if (std::string(folder) == "kernels") made.kernels.insert(entry.path().filename().string());
      }
    return made;
  }();
  return known;
}

/// Returns one line for each name in `text` that the repository does not contain.
std::vector<std::string> gone(const std::string& text) {
  static const std::regex function(R"(`(?:\w+::)*(\w+)\(\)`)");
  static const std::regex placed(
      R"(`(\w+)(?:\(\))?`\s+(?:in|of)\s+`((?:harness|kernels|shaders|tests)/[\w/.]+\.\w+)`)");
  static const std::regex path(
      R"(`((?:harness|kernels|shaders|tests|docs|experiments|examples|scripts|results|bench)/[\w/.*-]*)`)");
  static const std::regex kernel(R"(`(\w+\.(?:cl|clh))`)");
  const auto each = [&](const std::regex& pattern, const auto& visit) {
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
      visit(*match);
  };
  std::vector<std::string> faults;
  each(function, [&](const std::smatch& m) {
    if (!tree().words.contains(m[1])) faults.push_back(fmt::format("{}: no such function", m.str()));
  });
  each(placed, [&](const std::smatch& m) {
    if (!words_of(pelage::test::text_of(root / m[2].str())).contains(m[1]))
      faults.push_back(fmt::format("{}: the file has no such name", m.str()));
  });
  each(path, [&](const std::smatch& m) {
    const std::string name = m[1].str();  // a name may be a pattern, such as grass-*.toml
    if (!fs::exists(root /
                    (name.find('*') == std::string::npos ? fs::path(name) : fs::path(name).parent_path())))
      faults.push_back(fmt::format("{}: no such file", m.str()));
  });
  each(kernel, [&](const std::smatch& m) {
    if (!tree().kernels.contains(m[1])) faults.push_back(fmt::format("{}: no such kernel", m.str()));
  });
  return faults;
}

}  // namespace

TEST(Documents, NameWhatExists) {
  std::vector<fs::path> documents{root / "README.md", root / "ARTIFACT.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") documents.push_back(entry.path());
  EXPECT_GT(documents.size(), 8u);
  for (const fs::path& document : documents)
    for (const std::string& fault : gone(pelage::test::text_of(document)))
      ADD_FAILURE() << document.lexically_relative(root).generic_string() << ": " << fault;
}

TEST(Documents, PlantedNamesAreFound) {
  for (const char* text : {"(`no_such_function()` there)", "`pelage::gone_from_here()`",
                           "`kernels/wet/gone.cl`", "`results/gone/`", "`tests/topology/shim*.cpp`",
                           "`gone_sort.cl`", "`lit_by` in `kernels/rasterize/shading/fragment.clh`",
                           "`lit_by()` of\n`kernels/wet/wet.cl`, `lit_by()` of `kernels/wet/wet.cl`",
                           "(`lit_by` in\n  `kernels/rasterize/shading/fragment.clh`)"})
    EXPECT_GE(gone(text).size(), 1u) << text;
  for (const char* text :
       {"`main()`", "`kernels/wet/wet.cl`", "`docs/`", "`wet.cl`", "`examples/grass-*.toml`", "`pelage list`",
        "`B(t_n)`", "`pelage::check_against_reference()`", "`main` in `harness/main.cpp`"})
    EXPECT_TRUE(gone(text).empty()) << text;
}
