// Tests the datasets of a dump of shells, with which the table of docs/dump.md is written.
#include "harness/dump/dump.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>

#include "tests/dump/table.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// Writes a dump of the frame `input`, drawn by the reference, and returns its datasets.
Datasets dumped(const FrameInput& input) {
  std::string folder = (fs::temp_directory_path() / "pelage-dump-XXXXXX").string();
  if (!mkdtemp(folder.data())) std::abort();
  const fs::path path = fs::path(folder) / "frame.h5";
  const FrameOutput output = reference_output(input, 2, false);
  write_dump(path, {input.scene, *input.mesh, output.image, output.pipeline, 2},
             [&](Hdf5File& file) { dump::write_shells(file, input, output); });
  const Datasets found = datasets_of(path);
  fs::remove_all(folder);
  return found;
}

/// The sizes of this frame differ from each other and from the constants of docs/dump.md.
FrameInput frame_of(const std::string& topology, const std::string& binding) {
  Scene scene = synthetic::lively_scene();
  scene.fur.layers = 5;
  scene.fur.binding = binding;
  scene.dynamics.topology = topology;
  scene.wetness.size = 50;
  scene.image.width = 60;
  scene.image.height = 40;
  return synthetic::frame(scene, synthetic::torus(), 12, 8, 7);
}

Dumped shells(const std::string& scenes, const FrameInput& input) {
  const std::size_t faces = input.mesh->triangle.size();
  const auto text = [](auto number) { return fmt::format("{}", number); };
  Dumped dump{scenes, dumped(input), {}};
  dump.symbols = {{text(input.mesh->position.size()), "V"},
                  {text(input.mesh->welded), "W"},
                  {text(input.mesh->welded + 1), "W+1"},
                  {text(faces), "F"},
                  {text(3 * faces), "3F"},
                  {text(input.droplets.size()), "D"},
                  {text(input.scene.wetness.size), "S"},
                  {text(input.scene.fur.layers), "N"},
                  {text(input.camera.height), "height"},
                  {text(input.camera.width), "width"},
                  {"21", "rows"},
                  {"22", "columns"},
                  {"23", "depth"}};
  EXPECT_EQ(dump.symbols.size(), 13u) << "two sizes of the frame are equal";
  return dump;
}

/// All maps of the fur's shape, as constants.
FrameInput with_maps(FrameInput input) {
  const std::size_t faces = input.mesh->triangle.size(), points = input.mesh->welded;
  input.style.length.assign(faces, 0.5f);
  input.style.comb.assign(points, 1.0f);
  input.style.curl_radius.assign(points, 0.25f);
  input.style.curl_turns.assign(points, 0.75f);
  input.style.density = {22, 21, std::vector<float>(21 * 22, 0.5f)};
  return input;
}

FrameInput with_field(FrameInput input) {
  auto field = std::make_shared<DistanceField>();
  field->nodes = {22, 21, 23};
  field->cell = 1;
  field->distance.assign(21 * 22 * 23, 1.0f);
  input.contact_field = field;
  return input;
}

// Every dataset has a line in the table of docs/dump.md, with its shape, units and description.
TEST(DumpTable, IsWrittenFromTheDumps) {
  const FrameInput silva = frame_of("silva", "shared");
  const std::vector<Dumped> plain{shells("face springs", silva),
                                  shells("face springs", frame_of("silva", "separate")),
                                  shells("sticks", frame_of("sticks", "shared")),
                                  shells("sticks", frame_of("separable-prisms", "shared"))};
  std::string table = table_of(plain);
  for (const Dumped& more : {shells("maps", with_maps(silva)), shells("`contact.mesh`", with_field(silva))}) {
    Dumped added{more.scenes, {}, more.symbols};
    for (const auto& [name, found] : more.file)
      if (!plain.front().file.contains(name)) added.file.emplace(name, found);
    EXPECT_FALSE(added.file.empty());
    const std::string lines = table_of({added, {"", {}, {}}});  // without the empty dump: "always"
    table += lines.substr(lines.find("| `"));
  }
  expect_in_document("shells", table);
}

struct Dumps : testing::TestWithParam<std::pair<const char*, const char*>> {};

// A dump has the datasets of its kind of motion, with the sizes of the frame.
TEST_P(Dumps, HoldWhatTheDocumentSaysAndNothingElse) {
  const auto [topology, binding] = GetParam();
  const FrameInput input = frame_of(topology, binding);
  const bool springs = has_springs(input.scene.dynamics);
  const Datasets file = dumped(input);
  std::ifstream stream(fs::path(PELAGE_SOURCE_DIR) / "docs/dump.md");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  static const std::regex row(R"(\n\| `([^`]+)` \| (always|face springs|sticks) \| ([^|]+), \w+ \|)");
  const std::size_t end = text.find("<!-- shells ends");
  std::size_t rows = 0;
  for (std::sregex_iterator m(text.begin(), text.begin() + std::ptrdiff_t(end), row), last; m != last; ++m) {
    const std::string name = (*m)[1] == "fur_mip/L" ? "fur_mip/1" : (*m)[1].str();
    const bool expected = (*m)[2] == "always" || (*m)[2] == (springs ? "sticks" : "face springs");
    EXPECT_EQ(file.contains(name), expected) << name;
    ++rows;
  }
  EXPECT_GT(rows, 40u);
  const Dumped dump = shells("", input);
  const bool corners = parts(input.scene);
  EXPECT_EQ(shape_of("strand/root", dump), (!springs ? "F x 3" : corners ? "3F x 3" : "W x 3"));
  EXPECT_EQ(shape_of("layer/offset", dump), corners ? "N x 3F x 3" : "N x V x 3");
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

// docs/shells.md may name only datasets of the table of docs/dump.md.
TEST(Document, NamesOnlyDatasetsOfItsTable) {
  const auto read = [](const char* name) {
    std::ifstream stream(fs::path(PELAGE_SOURCE_DIR) / "docs" / name);
    return std::string{std::istreambuf_iterator<char>(stream), {}};
  };
  const std::string rules = read("shells.md"), table = read("dump.md");
  static const std::regex name("`((?:mesh|tangent|curl|strand|weight|stick|droplet|layer|camera)/\\w+)`");
  std::size_t named = 0;
  for (std::sregex_iterator m(rules.begin(), rules.end(), name), end; m != end; ++m, ++named)
    EXPECT_NE(table.find("\n| `" + (*m)[1].str() + "` |"), std::string::npos) << (*m)[1];
  EXPECT_GT(named, 20u);
}

}  // namespace
}  // namespace pelage
