// Tests that the documents name functions and files that exist, that their links lead somewhere, that the
// code cites documents and sections that exist, and that docs/code.md names every folder that contains code.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/house/rules.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace fs = std::filesystem;
using pelage::house::root;

namespace {

std::set<std::string> words_of(const std::string& text) {
  static const std::regex word(R"([A-Za-z_]\w*)");
  const std::vector<std::string> words = pelage::test::matches(text, word);
  return {words.begin(), words.end()};
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
      for (const fs::path& file : pelage::test::files_below(root / folder)) {
        if (file.filename() == "documents_test.cpp") continue;
        made.words.merge(words_of(pelage::test::text_of(file)));
        if (std::string(folder) == "kernels") made.kernels.insert(file.filename().string());
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

std::vector<fs::path> documents() {
  std::vector<fs::path> found{root / "README.md", root / "ARTIFACT.md"};
  for (const char* folder : {"docs", "results"})
    for (const auto& entry : fs::directory_iterator(root / folder))
      if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

std::vector<std::string> titles_of(const std::string& text) {
  std::vector<std::string> titles;
  for (const std::string& line : pelage::test::lines_of(text))
    if (const std::size_t end = line.find_first_not_of('#');
        line.starts_with('#') && end != std::string::npos)
      titles.push_back(line.substr(end + 1));
  return titles;
}

/// Returns the name that a link gives to a section: lower case, - for blanks, without other punctuation.
std::string anchor_of(const std::string& title) {
  std::string anchor;
  for (const char c : title)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ')
      anchor += '-';
  return anchor;
}

/// Returns one line for each link of a document in `folder` that does not lead to a file or a section.
std::vector<std::string> dead_links(const std::string& text, const fs::path& folder) {
  static const std::regex link(R"(\]\(([^)#\s]*)(?:#([^)\s]+))?\))");
  std::vector<std::string> faults;
  for (std::sregex_iterator match(text.begin(), text.end(), link), end; match != end; ++match) {
    const std::string to = (*match)[1], section = (*match)[2];
    if (to.starts_with("http")) continue;
    if (!fs::exists(folder / to)) {
      faults.push_back(fmt::format("{}: no such file", match->str()));
      continue;
    }
    if (section.empty()) continue;
    const std::vector<std::string> titles = titles_of(to.empty() ? text : pelage::test::text_of(folder / to));
    if (std::none_of(titles.begin(), titles.end(),
                     [&](const auto& one) { return anchor_of(one) == section; }))
      faults.push_back(fmt::format("{}: no such section", match->str()));
  }
  return faults;
}

/// Returns the titles of the sections of the document, which are read once.
const std::vector<std::string>& known_titles(const std::string& document) {
  static std::map<std::string, std::vector<std::string>> known;
  const auto [entry, fresh] = known.try_emplace(document);
  if (fresh) entry->second = titles_of(pelage::test::text_of(root / document));
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

/// Returns one line for each document, and each section such as "docs/strands.md, section Body", that `file`
/// cites and that does not exist. A citation may name several sections. Only the text behind the name of the
/// folder is searched, because a search with std::regex is slow.
std::vector<std::string> dead_citations(const std::string& file) {
  static const std::regex line_end(R"(\s*\n\s*(///?|#|\*)?\s*)"), name(R"re(^\w+/([\w-]+\.md)\b)re"),
      section(R"re(^[^.;]{0,100}?\bsections? (?=["A-Z0-9]))re"),
      next_one(R"re(^"?(, and |, | and | to )"?(?=[A-Z0-9]))re");
  std::vector<std::string> faults;
  for (const std::string folder : {"docs/", "results/"})
    for (std::size_t at = file.find(folder); at != std::string::npos; at = file.find(folder, at + 1)) {
      // The end of the text is not a letter, so that cited() may look at the character after a title.
      const std::string text = std::regex_replace(file.substr(at, 300), line_end, " ") + ".";
      std::smatch document, m;
      if (!std::regex_search(text, document, name)) continue;
      if (!fs::exists(root / document.str())) {
        faults.push_back(fmt::format("{}: no such document", document.str()));
        continue;
      }
      std::string rest = document.suffix();
      if (!std::regex_search(rest, m, section) || m.str().find("docs/") != std::string::npos) continue;
      rest = std::string(m.suffix());
      for (bool more = true; more;) {
        if (rest.starts_with('"')) rest.erase(0, 1);
        const auto& titles = known_titles(document.str());
        const std::size_t size = cited(rest, titles);
        if (size == 0)
          faults.push_back(fmt::format("{}, section {}: no such section", document.str(),
                                       rest.substr(0, rest.find_first_of(".,;)"))));
        rest.erase(0, size);
        std::smatch link;
        more = size > 0 && std::regex_search(rest, link, next_one) && cited(link.suffix(), titles) > 0;
        if (more) rest = std::string(link.suffix());
      }
    }
  return faults;
}

}  // namespace

TEST(Documents, NameWhatExists) {
  EXPECT_GT(documents().size(), 8u);
  for (const fs::path& document : documents()) {
    const std::string text = pelage::test::text_of(document),
                      name = document.lexically_relative(root).generic_string();
    for (const std::string& fault : gone(text)) ADD_FAILURE() << name << ": " << fault;
    for (const std::string& fault : dead_links(text, document.parent_path()))
      ADD_FAILURE() << name << ": " << fault;
  }
}

TEST(Documents, NameEveryFolderWithCode) {
  const std::string document = pelage::test::text_of(root / "docs/code.md");
  std::set<std::string> folders;
  for (const char* top : {"harness", "kernels"})
    for (const auto& entry : fs::recursive_directory_iterator(root / top))
      if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cl")
        folders.insert(entry.path().parent_path().lexically_relative(root).generic_string());
  for (const std::string& folder : folders) EXPECT_NE(document.find(folder), std::string::npos) << folder;
}

// Tables that are written from code or results do not count: whole pages, or the lines between two marks.
TEST(Documents, TogetherHaveAtMost35000Words) {
  static const std::set<std::string> written{"results/README.md", "results/claims.md"};
  std::size_t words = 0;
  for (const fs::path& document : documents()) {
    if (written.contains(document.lexically_relative(root).generic_string())) continue;
    bool counts = true;
    for (const std::string& line : pelage::test::lines_of(pelage::test::text_of(document))) {
      if (line.starts_with("<!-- ")) counts = line.find(" begin") == std::string::npos;
      std::istringstream stream(line);
      if (counts)
        words += std::size_t(
            std::distance(std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()));
    }
  }
  EXPECT_GT(words, 20000u);
  EXPECT_LE(words, 35000u);
}

TEST(Documents, CitedByTheCodeExist) {
  std::size_t files = 0;
  for (const std::string& file : pelage::house::written_files()) {
    if (file.find('/') == std::string::npos || file.ends_with("documents_test.cpp")) continue;
    ++files;
    for (const std::string& fault : dead_citations(pelage::test::text_of(root / file)))
      ADD_FAILURE() << file << ": " << fault;
  }
  EXPECT_GT(files, 500u);
}

TEST(Documents, PlantedLinksAndCitationsAreFound) {
  const fs::path docs = root / "docs";
  EXPECT_EQ(dead_links("[a](gone.md) [b](code.md#gone) [c](#gone)\n# Here\n", docs).size(), 3u);
  EXPECT_TRUE(dead_links("[a](code.md#kernels) [b](../README.md) [c](#it-is-here) [d](https://x.org)\n"
                         "## It is: here\n",
                         docs)
                  .empty());
  for (const char* text : {"docs/gone.md", "// docs/gone.md, section 1", "results/gone.md"})
    EXPECT_EQ(dead_citations(text).size(), 1u) << text;
  EXPECT_TRUE(dead_citations("docs/code.md, results/README.md").empty());
}

TEST(Documents, PlantedSectionsAreFound) {
  for (const char* text : {"(docs/strands.md, section Simulation)",
                           "docs/strands.md derives the\n// scheme in the section\n// Simulation.",
                           "`docs/shells.md`, section 99", "docs/nothing.md, section 1",
                           "docs/strands.md, section \"Time steps\""})
    EXPECT_EQ(dead_citations(text).size(), 1u) << text;
  for (const char* text :
       {"(docs/strands.md, section Body)", "docs/strands.md, section \"Time step\".",
        "docs/strands.md, sections Model and Stops", "`docs/shells.md`, section 6",
        "docs/shells.md, sections 3, 4 and 5, and section 4 of a paper",
        "docs/shells.md. Section 99 of a paper", "docs/shells.md; docs/strands.md, section Moving\n/// skin"})
    EXPECT_TRUE(dead_citations(text).empty()) << text;
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
