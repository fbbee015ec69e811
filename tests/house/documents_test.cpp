// Tests that every function `name()` and every file that the documents name in backticks exists, and that the
// sections of documents that any file cites exist.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
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

/// Returns the titles of a document's sections. Empty if there is no such document.
std::vector<std::string> titles_of(const std::string& document) {
  static std::map<std::string, std::vector<std::string>> known;
  const auto [entry, fresh] = known.try_emplace(document);
  std::ifstream lines(root / "docs" / document);
  for (std::string line; fresh && std::getline(lines, line);)
    if (line.starts_with("#")) entry->second.push_back(line.substr(line.find_first_not_of("# ")));
  return entry->second;
}

/// Returns the number of characters at the beginning of `text` that cite one of the sections: the number of a
/// section, or its title with or without its number. 0 if no title fits.
std::size_t cited(const std::string& text, const std::vector<std::string>& titles) {
  static const std::regex numbered(R"((\d+)\.? (.*))");
  std::size_t most = 0;
  const auto try_name = [&](const std::string& name) {
    if (text.starts_with(name) && !std::isalnum(static_cast<unsigned char>(text[name.size()])))
      most = std::max(most, name.size());
  };
  for (const std::string& title : titles) {
    try_name(title);
    std::smatch m;
    if (std::regex_match(title, m, numbered)) try_name(m[1]), try_name(m[2]);
  }
  return most;
}

/// Returns one line for each citation such as "docs/chains.md, section Body" of a section that does not
/// exist. A citation may name several sections.
std::vector<std::string> gone_sections(const std::string& file) {
  static const std::regex line_end(R"(\s*\n\s*(///?|#|\*)?\s*)"),
      citation(R"re(^docs/([\w-]+\.md)[^.;]{0,100}?\bsections? (?=["A-Z0-9]))re"),
      next_one(R"re(^"?(, and |, | and | to )"?(?=[A-Z0-9]))re");
  std::vector<std::string> faults;
  for (std::size_t at = file.find("docs/"); at != std::string::npos; at = file.find("docs/", at + 1)) {
    // The end of the text is not a letter, so that cited() may look at the character after a title.
    const std::string text = std::regex_replace(file.substr(at, 300), line_end, " ") + ".";
    std::smatch m;
    if (!std::regex_search(text, m, citation) || m.str().find("docs/", 1) != std::string::npos) continue;
    std::string rest = m.suffix();
    for (bool more = true; more;) {
      if (rest.starts_with('"')) rest.erase(0, 1);
      const std::size_t size = cited(rest, titles_of(m[1]));
      if (size == 0)
        faults.push_back(
            fmt::format("{}{}: no such section", m.str(), rest.substr(0, rest.find_first_of(".,;)"))));
      rest.erase(0, size);
      std::smatch link;
      more = size > 0 && std::regex_search(rest, link, next_one) && cited(link.suffix(), titles_of(m[1])) > 0;
      if (more) rest = link.suffix();
    }
  }
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

TEST(Documents, CitedSectionsExist) {
  std::vector<fs::path> files{root / "README.md", root / "ARTIFACT.md"};
  for (const char* folder : {"harness", "kernels", "shaders", "tests", "bench", "scripts", "docs",
                             "experiments", "examples", "python"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file() && entry.path().filename() != "documents_test.cpp")
        files.push_back(entry.path());
  for (const fs::path& file : files)
    for (const std::string& fault : gone_sections(read(file)))
      ADD_FAILURE() << file.lexically_relative(root).generic_string() << ": " << fault;
}

TEST(Documents, PlantedSectionsAreFound) {
  for (const char* text :
       {"(docs/chains.md, section Simulation)",
        "docs/chains.md derives the\n// scheme in the section\n// Simulation.", "`docs/frame.md`, section 99",
        "docs/nothing.md, section 1", "docs/chains.md, section \"Time steps\""})
    EXPECT_EQ(gone_sections(text).size(), 1u) << text;
  for (const char* text :
       {"(docs/chains.md, section Body)", "docs/chains.md, section \"Time step\".",
        "docs/chains.md, sections Model and Stops", "`docs/frame.md`, section 6",
        "docs/frame.md, sections 3, 4 and 5, and section 4 of a paper",
        "docs/frame.md. Section 99 of a paper", "docs/frame.md; docs/chains.md, section Moving\n/// skin"})
    EXPECT_TRUE(gone_sections(text).empty()) << text;
}
