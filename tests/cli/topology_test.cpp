// Tests that pelage topology prints the numbers of masses and springs that Banisch and Wuethrich 2006 give.
// In this file, "the paper" is that paper.
#include <regex>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

/// Returns the numbers of masses and springs in the output row `name` as "MASSES SPRINGS", or "" if
/// there is no such row.
std::string row_of(const std::string& text, const std::string& name) {
  std::smatch found;
  const std::regex row("(^|\n)" + name + " +([0-9]+) +([0-9]+) ");
  return std::regex_search(text, found, row) ? found[2].str() + " " + found[3].str() : "";
}

struct TopologyCommand : InFolder {};

// The error after one second needs a step that divides the second; otherwise the motion ends at another time.
TEST_F(TopologyCommand, RefusesAStepThatDoesNotDivideTheSecond) {
  const std::string run = "run banisch2006-work-precision --preset smoke --filter rk4 --axis dynamics.step=";
  const Outcome uneven = pelage(run + "0.00417 -o uneven");
  EXPECT_EQ(uneven.code, 1);
  expect_has(uneven.err,
             {"dynamics.step = 0.00417: 240 steps end at 1.0008 s", "give 0.004166666667, or another step"});
  expect_has(done(run + "0.004166666667 -o even").err, "ms (one simulated second)");
}

TEST_F(TopologyCommand, CountsThePapersModels) {
  const Outcome grass = done("topology banisch-grass");
  expect_has(grass.out, "13 surface points");
  EXPECT_EQ(row_of(grass.out, "sticks"), "26 13");
  // A disk with V = 13 vertices and F = 16 faces has V + F - 1 = 28 edges (Euler's formula). The topology
  // `prisms` has one spring per vertex and one spring per edge.
  EXPECT_EQ(row_of(grass.out, "prisms"), "26 41");
  EXPECT_EQ(row_of(grass.out, "separable-sticks"), "96 48");
  EXPECT_EQ(row_of(grass.out, "separable-prisms"), "96 96");
  const Outcome elephant = done("topology banisch-elephant");
  EXPECT_EQ(row_of(elephant.out, "separable-prisms"), "6888 6888");
  EXPECT_EQ(row_of(elephant.out, "separable-sticks"), "6888 3444");
  EXPECT_NE(row_of(elephant.out, "sticks on vertex copies"), "");
  // pelage topology must print the paper's numbers only for the models and topologies for which the paper
  // gives them.
  const auto ends_with = [&](const std::string& name, const std::string& end) {
    return std::regex_search(elephant.out, std::regex("\n" + name + " [^\n]* " + end + "\n"));
  };
  EXPECT_TRUE(ends_with("sticks", "1247 / 623")) << elephant.out;
  EXPECT_TRUE(ends_with("separable-prisms", "6888 / 6888")) << elephant.out;
  expect_lacks(grass.out, "the paper");
  expect_lacks(pelage("topology banisch-elephant --faces 1146").out, "1247");
}

// docs/springs.md shows what `pelage topology MODEL --markdown` prints for the paper's three models.
TEST_F(TopologyCommand, PrintsTheTableOfTheDocument) {
  std::string table;
  for (const char* model : {"banisch-elephant", "banisch-dog", "banisch-grass"}) {
    const std::string printed = done(std::string("topology --markdown ") + model).out;
    const std::size_t rows = printed.find('\n', printed.find('\n') + 1) + 1;  // after the head and its line
    table += table.empty() ? printed : printed.substr(rows);
  }
  const std::string document = test::text_of(fs::path(PELAGE_SOURCE_DIR) / "docs/springs.md");
  const std::string begin = "<!-- counts begin: pelage topology MODEL --markdown prints them -->\n";
  const std::size_t from = document.find(begin) + begin.size(), to = document.find("<!-- counts end -->");
  ASSERT_LT(from, to);
  EXPECT_EQ(document.substr(from, to - from), table);
  // With another number of faces, the model is not the paper's.
  expect_lacks(done("topology banisch-elephant --faces 1146 --markdown").out, "the paper");
}

// The drawing has one panel for each of the four topologies. The test counts the SVG elements. Each panel
// must contain every triangle of the mesh once, and every mass and spring of its topology once.
TEST_F(TopologyCommand, DrawsWhatItCounts) {
  done("topology banisch-grass --draw grass.svg --length 0.4");
  const std::string svg = folder.read("grass.svg");
  EXPECT_TRUE(svg.starts_with("<svg ")) << svg.substr(0, 40);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_EQ(test::count_of(svg, "class=\"skin\""), 4 * 16u);
  EXPECT_EQ(test::count_of(svg, "class=\"stick\""), 13 + 13 + 48 + 48u);
  EXPECT_EQ(test::count_of(svg, "class=\"edge\""), 28 + 48u);
  EXPECT_EQ(test::count_of(svg, "<circle"), 26 + 26 + 96 + 96u);
  expect_has(svg, "separable-prisms: 96 masses, 96 springs");
}

}  // namespace
}  // namespace pelage::cli
