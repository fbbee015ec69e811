// Tests the commands of pelage with valid input.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <vector>

#include "harness/compare/metrics.hpp"
#include "harness/picture/image_io.hpp"
#include "tests/cli/shell.hpp"
#include "tests/dump/table.hpp"

namespace pelage::cli {
namespace {

struct Commands : InFolder {};

TEST_F(Commands, HelpAndVersionGoToStdout) {
  const Outcome help = done("--help");
  EXPECT_EQ(help.err, "");
  for (const char* command : {"devices", "scene", "render", "check"}) {
    expect_has(help.out, command);
    expect_has(done(std::string(command) + " --help").out, "Usage: pelage " + std::string(command));
  }
  expect_has(done("--version").out, "cite");
}

TEST_F(Commands, ThePrintedSceneReadsBackToItself) {
  const Outcome first = done("scene --set fur.layers=16 --set shading.model=wet --set model=torus");
  EXPECT_EQ(first.err, "");
  folder.write("written.toml", first.out);
  const Outcome second = pelage("scene written.toml");
  EXPECT_EQ(second.out, first.out);
  expect_has(second.out, "\nlayers = 16 ");
}

std::vector<glm::dvec3> vectors(const std::vector<float>& values) {
  std::vector<glm::dvec3> list;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    list.emplace_back(values[i], values[i + 1], values[i + 2]);
  return list;
}

using Shape = std::vector<std::string>;

TEST_F(Commands, AnExampleSceneHasAName) {
  const std::string by_path = pelage("scene '" PELAGE_SOURCE_DIR "/examples/wet-curls.toml'").out;
  expect_has(by_path, "[fur]");
  for (const char* name : {"wet-curls", "wet-curls.toml"})
    EXPECT_EQ(pelage(std::string("scene ") + name).out, by_path) << name;
  expect_has(pelage("scene wet-curls --model mine.obj --up z").out, {"/mine.obj\"", "up = \"z\""});
  folder.write("wet-curls", "fur.layers = 7\n");
  expect_has(pelage("scene wet-curls").out,
             "layers = 7");  // a file of the user comes before an example
}

TEST_F(Commands, TheDumpHoldsAFrameThatFitsTogether) {
  done(
      "render --model torus --pipeline reference --size 40x30 --set fur.layers=4 --set fur.texture=32 --set wetness.random=50 --set dynamics.gravity=[0,-9,0] --set dynamics.time=0.2 -o image.exr --dump frame.h5");
  const fs::path path = folder.path / "frame.h5";
  const Datasets file = datasets_of(path);
  for (const char* name :
       {"mesh/position", "mesh/triangle", "mesh/uv", "mesh/normal", "strand/root", "strand/rest",
        "strand/tip", "mask", "fur", "colour", "layer/offset", "camera/view", "camera/projection", "image"}) {
    const std::vector<float> values = floats_of(path, name);
    EXPECT_FALSE(values.empty()) << name;
    EXPECT_FALSE(file.at(name).units.empty()) << name;
    for (const float value : values) ASSERT_TRUE(std::isfinite(value)) << name;
  }
  const auto vectors_of = [&](const char* name) { return vectors(floats_of(path, name)); };
  const std::vector<glm::dvec3> position = vectors_of("mesh/position"),
                                triangle = vectors_of("mesh/triangle");
  const std::size_t vertices = position.size(), faces = 9360;
  EXPECT_EQ(triangle.size(), faces);
  EXPECT_EQ(file.at("mask").shape, (Shape{"256", "256", "4"}));
  EXPECT_EQ(file.at("fur").shape, (Shape{"4", "32", "32", "2"}));
  EXPECT_EQ(file.at("fur_mip/1").shape, (Shape{"4", "16", "16", "2"}));
  EXPECT_EQ(file.at("layer/offset").shape, (Shape{"4", std::to_string(vertices), "3"}));

  // The distance from a root to its tip must be at most the length of the strand. Gravity must have moved
  // some tips.
  const std::vector<glm::dvec3> root = vectors_of("strand/root"), rest = vectors_of("strand/rest"),
                                tip = vectors_of("strand/tip");
  double moved = 0;
  for (std::size_t f = 0; f < faces; ++f) {
    EXPECT_NEAR(glm::distance(rest[f], root[f]), 0.09, 1e-5);
    EXPECT_LE(glm::distance(tip[f], root[f]), 0.09 + 1e-5);
    moved = std::max(moved, glm::distance(tip[f], rest[f]));
  }
  EXPECT_GT(moved, 0.005);

  // A strand's tip offset is its tip minus its root. Each triangle has one strand. Without curl, the offset
  // of the uppermost layer at a surface point is a weighted mean of tip offsets. The mean is over the
  // triangles around the point, and the weights are the areas of the triangles. All vertices at one surface
  // point have bitwise equal positions.
  std::map<std::array<double, 3>, glm::dvec4> mean;
  const auto point = [&](std::size_t v) { return std::array{position[v].x, position[v].y, position[v].z}; };
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t corner[] = {std::size_t(triangle[f].x), std::size_t(triangle[f].y),
                                  std::size_t(triangle[f].z)};
    const double area = glm::length(
        glm::cross(position[corner[1]] - position[corner[0]], position[corner[2]] - position[corner[0]]));
    for (const std::size_t v : corner)
      mean.try_emplace(point(v), 0.0).first->second += area * glm::dvec4(tip[f] - root[f], 1);
  }
  const std::vector<glm::dvec3> offset = vectors_of("layer/offset");
  for (std::size_t v = 0; v < vertices; ++v) {
    const glm::dvec4 sum = mean.at(point(v));
    const glm::dvec3 apart = glm::abs(offset[3 * vertices + v] - glm::dvec3(sum) / sum.w);
    EXPECT_LE(std::max({apart.x, apart.y, apart.z}), 1e-6);
  }

  // All vertices must be in front of the camera. In the screen coordinates, the picture extends from -1 to 1
  // along x and along y. The means of the vertices' x and y must be between -4 and 4. A row of a matrix in
  // the file is a column of a matrix of GLM, so the vector stands on the left.
  const glm::dmat4 view(glm::make_mat4(floats_of(path, "camera/view").data())),
      projection(glm::make_mat4(floats_of(path, "camera/projection").data()));
  glm::dvec4 middle(0);
  for (const glm::dvec3& p : position) {
    const glm::dvec4 screen = glm::dvec4(p, 1) * view * projection;
    ASSERT_GT(screen.w, 0);
    middle += screen / screen.w / double(vertices);
  }
  EXPECT_LT(std::abs(middle.x), 4);
  EXPECT_LT(std::abs(middle.y), 4);

  // The dataset "image" is equal to the picture that the same command wrote.
  EXPECT_EQ(file.at("image").shape, (Shape{"30", "40", "4"}));
  const std::vector<float> image = floats_of(path, "image");
  const Picture picture = read_picture(folder.path / "image.exr");
  for (std::size_t i = 0; i < picture.pixel.size(); ++i)
    for (int c = 0; c < 4; ++c) ASSERT_EQ(image[4 * i + std::size_t(c)], picture.pixel[i][c]);
}

TEST_F(Commands, ShellsAndReferenceDrawTheSamePicture) {
  const std::string scene =
      "render --model torus --size 80x60 --set fur.layers=8 --set curl.radius=0.02 --set curl.turns=2 ";
  for (const char* rest :
       {"-o tile.exr", "-o pixel.exr --mapping pixel", "-o reference.exr --pipeline reference",
        "-o eight.exr --pipeline reference --reference-bits 8"}) {
    const Outcome outcome = done(scene + rest);
    EXPECT_EQ(outcome.out, "");
  }
  const Picture reference = read_picture(folder.path / "reference.exr");
  for (const char* name : {"tile.exr", "pixel.exr"})
    EXPECT_TRUE(within(compare(read_picture(folder.path / name), reference))) << name;
  const Agreement eight = compare(read_picture(folder.path / "eight.exr"), reference);
  EXPECT_GT(eight.worst, 0.0) << "rounding to 8 bits changed nothing";
  EXPECT_GT(eight.psnr, 30.0);
}

TEST_F(Commands, ListNamesThePaperAndItsTableWhereThereIsOne) {
  const std::string list = done("list").out;
  expect_has(list, {"(silva2010-curling-clumping, Table 1)\n", "(banisch2006-grass-and-fur)\n"});
  for (const char* empty : {", )", "(, ", "()"}) EXPECT_FALSE(has(list, empty)) << list;
}

TEST_F(Commands, ARowSaysHowManyPixelsAreFlipped) {
  done("run silva2010-table1 --preset smoke --filter torus-16 -o out");
  const std::string rows = folder.read(journal_in(folder, "out"));
  expect_has(rows, R"({"against":"reference","metric":"flips","value":)");
  for (const char* metric : {R"("flips":{"value":)", R"("psnr_without_flips":{"value":)",
                             R"("windows_flips":{"value":)", R"("windows_psnr":{"value":)"})
    expect_has(rows, metric);
}

TEST_F(Commands, CheckComparesOneStage) {
  const Outcome outcome = done("check simulate mask --filter torus");
  expect_has(outcome.out, {"simulate", "mask"});
  expect_lacks(outcome.out, {"picture", "FAILED"});
}

TEST_F(Commands, CheckDrawsFirstWithTheDefaultMappingOfTheDevice) {
  // The check names the mapping of each comparison of pictures. A device with one lane per work-item must not
  // be asked for the mapping `tile`.
  const Outcome all = done("check picture mappings --filter 'torus.*curly'", "PELAGE_LANES=1");
  const auto group = all.out.find(", group"), pixel = all.out.find(", pixel");
  EXPECT_LT(group, pixel) << all.out;
  EXPECT_NE(pixel, std::string::npos) << all.out;
  expect_lacks(all.out, "tile");
  const Outcome one = done("check picture --mapping pixel --filter 'torus.*curly'", "PELAGE_LANES=1");
  expect_has(one.out, ", pixel");
  expect_lacks(one.out, "group");
  expect_refused(pelage("check picture --mapping tile", "PELAGE_LANES=1"), "mapping 'tile': on ");
}

TEST_F(Commands, CheckFailsOnKernelsThatAreWrong) {
  fs::copy(fs::path(PELAGE_SOURCE_DIR) / "kernels", folder.path / "kernels", fs::copy_options::recursive);
  // The test inserts a mistake into a copy of the kernels: it halves the wetness of all droplets.
  folder.edit("kernels/wet/equations.clh", ": drop.wetness;", ": 0.5f * drop.wetness;");
  const Outcome outcome = pelage("--kernels kernels check mask --mapping pixel --filter 'torus.*wet'");
  EXPECT_EQ(outcome.code, 1) << outcome.out << outcome.err;
  expect_has(outcome.out, "FAILED");
}

}  // namespace
}  // namespace pelage::cli
