// Compares the tables of equations in docs/shells.md and docs/springs.md with the comments of the kernels and
// the names of the tests.
#include <algorithm>
#include <regex>
#include <set>
#include <vector>

#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using test::text_of;

/// The name of an equation, and the name of a function that computes the equation.
using Line = std::pair<std::string, std::string>;

const std::regex numbered("[SWB] Eq\\. [0-9]|Algorithm [0-9]");

/// The comment above a function may name equations by their numbers. Returns the pair (equation, function)
/// for each equation that is named above a function of `source`.
std::set<Line> anchors_of(const std::string& source) {
  static const std::regex function(R"(^(?:static inline|INLINE) [\w ]+[ *](\w+)\()");
  std::set<Line> anchors;
  std::string comment;
  std::smatch match;
  for (const std::string& line : test::lines_of(source)) {
    if (line.rfind("//", 0) == 0) {
      comment += line.substr(2) + " ";
      continue;
    }
    if (std::regex_search(line, match, function)) {
      for (const std::string& equation : test::matches(comment, numbered))
        anchors.emplace(equation, match[1]);
    } else {
      // The comment ends at a line that contains neither a comment nor a function. A line with a function
      // does not end the comment, because the comment may also describe the function on the next line.
      comment.clear();
    }
  }
  return anchors;
}

TEST(EquationTable, IsWhatTheKernelsSay) {
  const fs::path root = PELAGE_SOURCE_DIR;
  std::set<Line> anchors;
  for (const fs::path& file : test::files_below(root / "kernels", ".clh"))
    anchors.merge(anchors_of(text_of(file)));
  std::set<std::string> tests;
  static const std::regex test(R"(TEST(_P|_F)?\(\s*(\w+),\s*(\w+)\))");
  for (const fs::path& file : test::files_below(root / "tests", ".cpp")) {
    const std::string source = text_of(file);
    for (std::sregex_iterator match(source.begin(), source.end(), test), end; match != end; ++match)
      tests.insert((*match)[2].str() + "." + (*match)[3].str());
  }

  std::set<Line> table;
  static const std::regex quoted("`([^`]+)`");
  const std::string document = text_of(root / "docs/shells.md") + text_of(root / "docs/springs.md");
  for (const std::string& row : test::lines_of(document)) {
    if (row.rfind("| S Eq", 0) != 0 && row.rfind("| W Eq", 0) != 0 && row.rfind("| B Eq", 0) != 0 &&
        row.rfind("| Algorithm", 0) != 0)
      continue;
    const std::string equations = row.substr(0, row.find('|', 1));
    const std::vector<std::string> names = test::matches(row, quoted);
    ASSERT_GE(names.size(), 5u) << row << " has no test";
    for (const std::string& equation : test::matches(equations, numbered)) table.emplace(equation, names[0]);
    // names[0] is a function of the kernels, and names[1] is its file. names[2] is a function of the
    // reference, and names[3] is its file.
    for (std::size_t i = 0; i < 4; i += 2)
      EXPECT_TRUE(std::regex_search(text_of(root / names[i + 1]), std::regex("\\b" + names[i] + "\\(")))
          << "no " << names[i] << " in " << names[i + 1];
    for (std::size_t i = 4; i < names.size(); ++i)
      EXPECT_TRUE(tests.contains(names[i])) << "no test " << names[i];
  }
  for (const Line& line : anchors)
    EXPECT_TRUE(table.contains(line)) << line.first << ", " << line.second << ": no row";
  for (const Line& line : table)
    EXPECT_TRUE(anchors.contains(line)) << line.first << ", " << line.second << ": not in kernels/";
  for (const char* equation :
       {"S Eq. 1", "S Eq. 2", "S Eq. 3", "S Eq. 4", "S Eq. 5", "S Eq. 6", "W Eq. 1", "W Eq. 2", "W Eq. 3",
        "W Eq. 4", "W Eq. 5", "B Eq. 1", "B Eq. 2", "B Eq. 3", "B Eq. 5", "Algorithm 1", "Algorithm 2"}) {
    EXPECT_TRUE(std::any_of(table.begin(), table.end(), [&](const Line& line) {
      return line.first == equation;
    })) << equation;
  }
}

}  // namespace
}  // namespace pelage
