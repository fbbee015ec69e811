// Tests that the documents name functions and files that exist, that their links lead somewhere, and that the
// code cites documents and sections that exist.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const fs::path root = PELAGE_SOURCE_DIR;

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

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
        made.words.merge(words_of(read(entry.path())));
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
    if (!words_of(read(root / m[2].str())).contains(m[1]))
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

/// Returns the titles of a document's sections.
std::vector<std::string> titles_of(const std::string& text) {
  std::vector<std::string> titles;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
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
    const std::vector<std::string> titles = titles_of(to.empty() ? text : read(folder / to));
    if (std::none_of(titles.begin(), titles.end(),
                     [&](const auto& one) { return anchor_of(one) == section; }))
      faults.push_back(fmt::format("{}: no such section", match->str()));
  }
  return faults;
}

/// Returns one line for each document or section that `text` cites as "docs/x.md" or "docs/x.md, section Y"
/// and that does not exist. A section is cited by its number, its title or the first words of its title. A
/// comment may break the citation over two lines.
std::vector<std::string> dead_citations(const std::string& text) {
  static const std::regex line_break(R"(\n[ \t]*(?:///?|#|\*)?<?[ \t]*)");
  static const std::regex citation(
      R"re((docs/[\w-]+\.md|results/[\w-]+\.md)`?(?:, sections? ("[^"]+"|[0-9]+|[A-Z][\w-]*))?)re");
  static const std::regex numbered("([0-9]+)[. ]+(.*)");
  std::vector<std::string> faults;
  for (std::size_t at = 0; (at = text.find(".md", at)) != std::string::npos; at += 3) {
    // Only the part of the text around the name is searched, because a search with std::regex is slow.
    const std::size_t start = std::max(text.rfind("docs/", at) + 1, text.rfind("results/", at) + 1);
    if (start == 0 || at - start > 60) continue;
    const std::string part = std::regex_replace(text.substr(start - 1, at - start + 100), line_break, " ");
    std::smatch match;
    if (!std::regex_search(part, match, citation, std::regex_constants::match_continuous)) continue;
    const fs::path document = root / match[1].str();
    if (!fs::exists(document)) {
      faults.push_back(fmt::format("{}: no such document", match.str()));
      continue;
    }
    std::string section = match[2];
    section.erase(std::remove(section.begin(), section.end(), '"'), section.end());
    const std::vector<std::string> titles = titles_of(read(document));
    if (!section.empty() && std::none_of(titles.begin(), titles.end(), [&](const std::string& title) {
          std::smatch parts;
          if (!std::regex_match(title, parts, numbered)) return title.starts_with(section);
          return parts[1] == section || parts[2].str().starts_with(section);
        }))
      faults.push_back(fmt::format("{}: no such section", match.str()));
  }
  return faults;
}

}  // namespace

TEST(Documents, NameWhatExists) {
  EXPECT_GT(documents().size(), 8u);
  for (const fs::path& document : documents()) {
    const std::string text = read(document), name = document.lexically_relative(root).generic_string();
    for (const std::string& fault : gone(text)) ADD_FAILURE() << name << ": " << fault;
    for (const std::string& fault : dead_links(text, document.parent_path()))
      ADD_FAILURE() << name << ": " << fault;
  }
}

TEST(Documents, CitedByTheCodeExist) {
  std::size_t files = 0;
  for (const char* folder : {"harness", "kernels", "shaders", "tests", "bench", "experiments", "examples",
                             "scripts", "python", "cmake", "docs"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      static const std::set<std::string> kinds{".cpp",  ".hpp",   ".h",   ".in",  ".cl", ".clh",
                                               ".vert", ".frag",  ".py",  ".sh",  ".md", ".toml",
                                               ".1",    ".cmake", ".txt", ".glsl"};
      if (!entry.is_regular_file() || !kinds.contains(entry.path().extension().string())) continue;
      if (entry.path().filename() == "documents_test.cpp") continue;
      ++files;
      for (const std::string& fault : dead_citations(read(entry.path())))
        ADD_FAILURE() << entry.path().lexically_relative(root).generic_string() << ": " << fault;
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
  for (const char* text :
       {"docs/gone.md", "// docs/code.md, section Gone", "// (docs/code.md,\n// section Gone)",
        "docs/code.md, section 7", "docs/code.md, section \"No such\""})
    EXPECT_EQ(dead_citations(text).size(), 1u) << text;
  for (const char* text :
       {"docs/code.md", "// docs/code.md,\n/// section Kernels", "`docs/code.md`, section \"A frame\""})
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
