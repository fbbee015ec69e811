// Tests that a dump has the datasets of docs/dump.md, with the same shapes and units.
#include "harness/dump/dump.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/dump/datasets_of.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

Datasets documented() {
  std::ifstream file(fs::path(PELAGE_SOURCE_DIR) / "docs/dump.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto begin = text.find("<!-- dump begins"), end = text.find("<!-- dump ends");
  Datasets found;
  if (begin == std::string::npos || end == std::string::npos) return found;
  static const std::regex row(R"(\| `([^`]+)` \| (\w+) \| ([^|]+), (\w+) \| ([^|]+) \| ([^|]+) \|)");
  std::istringstream lines(text.substr(begin, end - begin));
  for (std::string line; std::getline(lines, line);) {
    std::smatch m;
    if (!std::regex_match(line, m, row)) {
      EXPECT_FALSE(line.starts_with("| `")) << "no row of the table: " << line;
      continue;
    }
    EXPECT_TRUE(found.emplace(m[1], Dataset{m[2], m[4], m[5], m[6], words_of(m[3])}).second) << m[1];
  }
  return found;
}

/// Writes a dump of the frame `input`, drawn by the reference, and returns its datasets.
Datasets dumped(const FrameInput& input) {
  const test::Folder folder;
  dump_frame(folder.path / "frame.h5", input, reference_output(input, 2, false));
  return datasets_of(folder.path / "frame.h5");
}

FrameInput frame_of(const std::string& topology, const std::string& binding) {
  Scene scene = synthetic::lively_scene();
  scene.fur.layers = 3;
  scene.fur.binding = binding;
  scene.dynamics.topology = topology;
  return synthetic::frame(scene, synthetic::torus(), 12, 8, 5);
}

/// Returns the name under which the table of docs/dump.md describes `dataset`.
std::string row_of(const std::string& dataset) {
  return dataset.starts_with("fur_mip/") ? "fur_mip/L" : dataset;
}

struct Dumps : testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Dumps, HoldWhatTheDocumentSaysAndNothingElse) {
  const auto [topology, binding] = GetParam();
  const FrameInput input = frame_of(topology, binding);
  const bool springs = has_springs(input.scene.dynamics);
  const Datasets file = dumped(input), table = documented();
  ASSERT_GT(table.size(), 30u);

  const std::size_t vertices = input.mesh->position.size(), faces = input.mesh->triangle.size(),
                    points = input.mesh->welded;
  const std::size_t corners = 3 * faces, strands = !springs ? faces : parts(input.scene) ? corners : points;
  const std::map<std::string, std::size_t> symbols{{"V", vertices},
                                                   {"W", points},
                                                   {"W+1", points + 1},
                                                   {"F", faces},
                                                   {"D", input.droplets.size()},
                                                   {"S", std::size_t(input.scene.wetness.size)},
                                                   {"N", std::size_t(input.scene.fur.layers)},
                                                   {"Q", strands},
                                                   {"P", parts(input.scene) ? corners : vertices},
                                                   {"entries", input.strands.face.size()},
                                                   {"height", std::size_t(input.camera.height)},
                                                   {"width", std::size_t(input.camera.width)}};
  for (const auto& [name, found] : file) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(table.contains(row_of(name))) << "the document has no such dataset";
    const Dataset& row = table.at(row_of(name));
    EXPECT_NE(row.written, springs ? "silva" : "topology") << "written for another motion";
    EXPECT_EQ(found.type, row.type);
    EXPECT_EQ(found.units, row.units);
    EXPECT_NE(found.description, "");
    ASSERT_EQ(found.shape.size(), row.shape.size());
    for (std::size_t i = 0; i < row.shape.size(); ++i) {
      const std::string& symbol = row.shape[i];
      if (symbol == "side" || symbol == "bytes") continue;
      EXPECT_EQ(found.shape[i], symbols.contains(symbol) ? fmt::format("{}", symbols.at(symbol)) : symbol)
          << symbol;
    }
  }
  for (const auto& [name, row] : table) {
    const bool expected = row.written == "always" || row.written == (springs ? "topology" : "silva");
    const bool there = std::any_of(file.begin(), file.end(), [&, &wanted = name](const auto& one) {
      return row_of(one.first) == wanted;
    });
    EXPECT_EQ(there, expected) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Dumps,
                         testing::Values(std::pair("silva", "shared"), std::pair("silva", "separate"),
                                         std::pair("sticks", "shared"),
                                         std::pair("separable-prisms", "shared")),
                         [](const auto& given) {
                           std::string text = std::string(given.param.first) + "_" + given.param.second;
                           std::replace(text.begin(), text.end(), '-', '_');
                           return text;
                         });

// A scene with maps and with a mesh among its colliders has the datasets of both.
TEST(DumpOfMaps, HoldsThemAndTheField) {
  FrameInput input = frame_of("silva", "shared");
  const std::size_t faces = input.mesh->triangle.size(), points = input.mesh->welded;
  input.style.length.assign(faces, 0.5f);
  input.style.comb.assign(points, 1.0f);
  input.style.curl_radius.assign(points, 0.25f);
  input.style.curl_turns.assign(points, 0.75f);
  input.style.density = {3, 2, std::vector<float>(6, 0.5f)};
  auto field = std::make_shared<DistanceField>();
  field->nodes = {2, 3, 4};
  field->cell = 1;
  field->distance.assign(24, 1.0f);
  input.contact_field = field;
  const Datasets file = dumped(input), table = documented();
  const std::map<std::string, std::vector<std::string>> shapes{{"style/length", {fmt::format("{}", faces)}},
                                                               {"style/comb", {fmt::format("{}", points)}},
                                                               {"style/radius", {fmt::format("{}", points)}},
                                                               {"style/turns", {fmt::format("{}", points)}},
                                                               {"style/density", {"2", "3"}},
                                                               {"contact/field", {"4", "3", "2"}},
                                                               {"contact/grid", {"4"}}};
  for (const auto& [name, shape] : shapes) {
    ASSERT_TRUE(file.contains(name) && table.contains(name)) << name;
    EXPECT_EQ(file.at(name).shape, shape) << name;
    EXPECT_EQ(file.at(name).type, table.at(name).type) << name;
    EXPECT_EQ(file.at(name).units, table.at(name).units) << name;
  }
}

// docs/frame.md may name only datasets of the table of docs/dump.md.
TEST(Document, NamesOnlyDatasetsOfItsTable) {
  std::ifstream stream(fs::path(PELAGE_SOURCE_DIR) / "docs/frame.md");
  const std::string rules{std::istreambuf_iterator<char>(stream), {}};
  static const std::regex name("`((?:mesh|tangent|curl|strand|weight|stick|droplet|layer|camera)/\\w+)`");
  const Datasets table = documented();
  std::size_t named = 0;
  for (std::sregex_iterator m(rules.begin(), rules.end(), name), end; m != end; ++m, ++named)
    EXPECT_TRUE(table.contains((*m)[1])) << (*m)[1];
  EXPECT_GT(named, 20u);
}

}  // namespace
}  // namespace pelage
