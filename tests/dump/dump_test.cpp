// Tests the datasets of dumps, with which the tables of docs/dump.md are written.
#include "harness/dump/dump.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <regex>

#include "harness/compare/frame_output.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "tests/dump/table.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

std::string document(const char* name) {
  return test::text_of(std::filesystem::path(PELAGE_SOURCE_DIR) / "docs" / name);
}

/// Writes a dump of the frame `input` after `frames` frames, drawn by the reference, and reads it.
template <class Use>
auto dumped(const FrameInput& input, int frames, const Use& use) {
  const FrameOutput output = reference_output(input, frames, false);
  return with_dump(
      {input.scene, *input.mesh, output.image, output.pipeline, frames},
      [&](Hdf5File& file) { dump::write_shells(file, input, output); }, use);
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
  Dumped dump{scenes, dumped(input, 2, datasets_of), {}};
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
  input.style.density = {22, 21, std::vector<float>(std::size_t(21) * 22, 0.5f)};
  return input;
}

FrameInput with_field(FrameInput input) {
  auto field = std::make_shared<DistanceField>();
  field->nodes = {22, 21, 23};
  field->cell = 1;
  field->distance.assign(std::size_t(21) * 22 * 23, 1.0f);
  input.contact_fields = {field};
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
  const Datasets file = dumped(input, 2, datasets_of);
  const std::string text = document("dump.md");
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
                         test::by_parameter);

// docs/shells.md may name only datasets of the table of docs/dump.md.
TEST(Document, NamesOnlyDatasetsOfItsTable) {
  const std::string rules = document("shells.md"), table = document("dump.md");
  static const std::regex name("`((?:mesh|tangent|curl|strand|weight|stick|droplet|layer|camera)/\\w+)`");
  std::size_t named = 0;
  for (std::sregex_iterator m(rules.begin(), rules.end(), name), end; m != end; ++m, ++named)
    EXPECT_NE(table.find("\n| `" + (*m)[1].str() + "` |"), std::string::npos) << (*m)[1];
  EXPECT_GT(named, 20u);
}

// Tests that the dump of a frame whose water changes over time holds the arrival and the present wetness of
// every droplet (docs/shells.md, section 10).

TEST(WaterDump, HoldsTheWetnessOfThePicture) {
  Scene scene = synthetic::lively_scene();
  scene.fur.layers = 2;
  scene.wetness.soak = .05f;
  scene.dynamics.topology = "silva";
  FrameInput input = synthetic::frame(scene, synthetic::torus(), 12, 8, 8);
  for (std::size_t i = 0; i < 8; ++i) input.droplets[i].arrival = .01f * float(i);
  constexpr int frames = 4;  // the picture at 0.05 s, with the default step and substeps
  std::vector<float> arrival, rho, soaked;
  dumped(input, frames, [&](const std::filesystem::path& path) {
    arrival = floats_of(path, "droplet/arrival");
    rho = floats_of(path, "droplet/rho");
    soaked = floats_of(path, "droplet/wetness");
  });
  ASSERT_EQ(rho.size(), 8u);
  const double time = picture_time(scene.dynamics, frames);
  ASSERT_NEAR(time, .05, 1e-6);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(soaked[i], input.droplets[i].wetness);
    EXPECT_EQ(arrival[i], input.droplets[i].arrival);
    const double part = std::clamp((time - double(arrival[i])) / .05, 0.0, 1.0);
    EXPECT_NEAR(rho[i], part * double(soaked[i]), 1e-6) << "droplet " << i;
  }
  EXPECT_EQ(rho[7], 0) << "this droplet has not arrived";
}

// Every dataset of a dump of strands that other dumps do not have has a line in docs/dump.md. The sizes of
// the frame differ from each other and from the constants of docs/dump.md.
TEST(StrandsDumpTable, IsWrittenFromTheDump) {
  Scene scene;
  scene.model = "torus";
  scene.image.width = 60;
  scene.image.height = 40;
  scene.strands.layers.resize(5, scene.strands.layers.front());
  for (auto& layer : scene.strands.layers) layer.count = 61;
  scene.strands.fills.resize(9);
  const auto input =
      strands::prepare_strands(scene, std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 9, 6)));
  const StrandFrame frame = reference_strands(*input, 1);
  Dumped dump{"",
              with_dump(
                  {scene, *input->mesh, frame.picture, "strands-reference", 1},
                  [&](Hdf5File& file) { dump::write_strand_frame(file, *input, frame); }, datasets_of),
              {}};
  const auto text = [](auto number) { return fmt::format("{}", number); };
  dump.symbols = {{text(input->fur.keys.size()), "K"},
                  {text(input->fur.strands.size()), "S"},
                  {text(frame.order.size()), "D"},
                  {text(input->look.fills.size()), "L"},
                  {text(input->look.layers.size()), "B"},
                  {text(input->look.film.size()), "M"},
                  {text(input->mesh->position.size()), "V"},
                  {"40", "height"},
                  {"60", "width"}};
  EXPECT_EQ(dump.symbols.size(), 9u) << "two sizes of the frame are equal";
  std::erase_if(dump.file, [](const auto& one) {
    return one.first == "scene" || one.first.starts_with("mesh/") || one.first.starts_with("camera/");
  });
  EXPECT_GT(dump.file.size(), 20u);
  expect_in_document("strands", table_of({dump}));
}

// Tests the velocities in the dump of a frame that a device computed. They must agree with the velocities of
// the reference, in the same unit (the model's radius R per second) and in the same order.

struct Velocities : testing::TestWithParam<const char*> {};

TEST_P(Velocities, AreTheReferences) {
  constexpr int frames = 6;
  Scene scene = synthetic::lively_scene();
  scene.fur.layers = 2;
  scene.dynamics.topology = GetParam();
  const auto input = std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::torus(), 12, 8, 0));
  Shells shells(cl::choose_device(""), input);
  shells.advance(frames);
  const std::vector<glm::vec3> ours = shells.velocities();
  const FrameOutput reference = reference_motion(*input, frames);
  ASSERT_EQ(ours.size(), reference.velocities.size());
  ASSERT_EQ(ours.size(), reference.tips.size());
  double worst = 0, fastest = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    worst = std::max(worst, double(glm::length(ours[i] - reference.velocities[i])));
    fastest = std::max(fastest, double(glm::length(reference.velocities[i])));
  }
  EXPECT_LT(worst, tolerance::velocity);
  EXPECT_GT(fastest, 100 * tolerance::velocity) << "something moves";
}

INSTANTIATE_TEST_SUITE_P(Of, Velocities, testing::Values("silva", "sticks", "separable-prisms"),
                         test::by_parameter);

}  // namespace
}  // namespace pelage
