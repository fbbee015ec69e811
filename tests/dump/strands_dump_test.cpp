// Tests that a dump of strands has the datasets of docs/strands.md, section "The dump", with the same shapes
// and units.

#include <fstream>
#include <regex>
#include <sstream>

#include "harness/dump/strands.hpp"
#include "tests/dump/datasets_of.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// Returns the rows of the table in docs/strands.md. A row may name several datasets.
Datasets documented() {
  std::ifstream file(fs::path(PELAGE_SOURCE_DIR) / "docs/strands.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::istringstream lines(text.substr(text.find("## The dump")));
  static const std::regex row(R"(\| ((?:`[^`]+`(?:, )?)+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \|)"),
      name("`([^`]+)`");
  Datasets found;
  for (std::string line; std::getline(lines, line);) {
    std::smatch m;
    if (!std::regex_match(line, m, row)) continue;
    const std::string names = m[1], shape = std::regex_replace(m[2].str(), std::regex(" x "), " ");
    std::istringstream words(shape);
    const Dataset dataset{"", "", m[3], m[4], {std::istream_iterator<std::string>(words), {}}};
    for (std::sregex_iterator n(names.begin(), names.end(), name), end; n != end; ++n)
      found.emplace((*n)[1], dataset);
  }
  return found;
}

TEST(StrandsDump, HoldsWhatTheDocumentSaysAndNothingElse) {
  Scene scene;
  scene.model = "torus";
  scene.image.width = 60;
  scene.image.height = 40;
  scene.strands.layers.front().count = 300;
  scene.strands.fills.resize(2);
  const auto input =
      strands::prepare_strands(scene, std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 9, 6)));
  const StrandFrame frame = reference_strands(*input, 1);
  const test::Folder folder;
  const auto path = folder.path / "frame.h5";
  dump_strands(path, *input, frame, "strands-reference", 1);
  const Datasets file = datasets_of(path), table = documented();
  ASSERT_GT(table.size(), 15u);
  const std::map<std::string, std::size_t> symbols{{"K", input->fur.keys.size()},
                                                   {"S", input->fur.strands.size()},
                                                   {"D", frame.order.size()},
                                                   {"F", input->look.fills.size()},
                                                   {"B", input->look.layers.size()},
                                                   {"M", input->look.film.size()},
                                                   {"V", input->mesh->position.size()},
                                                   {"height", 40},
                                                   {"width", 60}};
  for (const auto& [name, found] : file) {
    SCOPED_TRACE(name);
    EXPECT_NE(found.description, "");
    if (name.starts_with("mesh/") || name.starts_with("camera/") || name == "scene") continue;
    ASSERT_TRUE(table.contains(name)) << "the document has no such dataset";
    const Dataset& row = table.at(name);
    EXPECT_EQ(found.units, row.units);
    ASSERT_EQ(found.shape.size(), row.shape.size());
    for (std::size_t i = 0; i < row.shape.size(); ++i)
      EXPECT_EQ(found.shape[i],
                symbols.contains(row.shape[i]) ? fmt::format("{}", symbols.at(row.shape[i])) : row.shape[i]);
  }
  for (const auto& [name, row] : table) EXPECT_TRUE(file.contains(name)) << name << " is not in the dump";
}

}  // namespace
}  // namespace pelage
