// pelage groom: the files are read here as their formats are described, without pelage's own code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <sstream>

#include "harness/compare/tolerances.hpp"
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

struct Groom : InFolder {
  /// Upright strands of equal lengths on a square that is normal to the y axis.
  std::string upright(const std::string& output) {
    folder.write("fur.toml", R"toml(model = "square"
pipeline = "strands"
[strands]
segments = 4
taper = 0.5
[[strands.layer]]
count = 300
length = 0.25
length_spread = 0
width = 0.01
lean = 0
colour = [1.0, 0.5, 0.25]
colour_spread = 0
[coat]
pattern = "plain"
colour = [0.8, 0.8, 0.8]
)toml");
    return done("groom fur.toml -o " + output).out;
  }
};

TEST_F(Groom, HairFilesHaveTheStrands) {
  EXPECT_EQ(upright("fur.hair"), "fur.hair: 300 strands of 5 points\n");
  const std::string bytes = folder.read("fur.hair");
  const auto whole = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, &bytes[at], sizeof value);
    return value;
  };
  const auto real = [&](std::size_t at) {
    float value = 0;
    std::memcpy(&value, &bytes[at], sizeof value);
    return value;
  };
  ASSERT_EQ(bytes.size(), 128u + 1500u * (12 + 4 + 12));
  EXPECT_EQ(bytes.substr(0, 4), "HAIR");
  EXPECT_EQ(whole(4), 300u);
  EXPECT_EQ(whole(8), 1500u);
  EXPECT_EQ(whole(12), 2u + 4 + 16) << "points, widths and colours";
  EXPECT_EQ(whole(16), 4u) << "segments of each strand";
  const std::size_t count = 1500, points = 128, widths = points + count * 12, colours = widths + count * 4;
  for (std::size_t i = 0; i < 1500; ++i) {
    const std::size_t root = i / 5 * 5;
    const float t = float(i % 5) / 4;
    EXPECT_EQ(real(points + 12 * i), real(points + 12 * root));
    EXPECT_NEAR(real(points + 12 * i + 4), 0.25f * t, 1e-6f);
    EXPECT_EQ(real(points + 12 * i + 8), real(points + 12 * root + 8));
    EXPECT_NEAR(real(widths + 4 * i), 0.01f * (1 - 0.5f * t), 1e-8f);
    EXPECT_NEAR(real(colours + 12 * i), 0.8f, 0.5f / 255);
    EXPECT_NEAR(real(colours + 12 * i + 4), 0.4f, 0.5f / 255);
    EXPECT_NEAR(real(colours + 12 * i + 8), 0.2f, 0.5f / 255);
  }
}

TEST_F(Groom, ObjFilesHaveTheSamePoints) {
  upright("fur.hair");
  EXPECT_EQ(upright("fur.obj"), "fur.obj: 300 strands of 5 points\n");
  const std::string bytes = folder.read("fur.hair");
  std::istringstream text(folder.read("fur.obj"));
  std::size_t points = 0, lines = 0;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      for (std::size_t k = 0; k < 3; ++k) {
        float value = 0, wanted = 0;
        words >> value;
        std::memcpy(&wanted, &bytes[128 + 12 * points + 4 * k], sizeof wanted);
        EXPECT_EQ(value, wanted);
      }
      ++points;
    }
    if (word == "l")
      for (std::size_t k = 1, index = 0; k <= 5; ++k) {
        words >> index;
        EXPECT_EQ(index, 5 * lines + k);
      }
    lines += word == "l";
  }
  EXPECT_EQ(points, 1500u);
  EXPECT_EQ(lines, 300u);
}

/// The points of an OBJ file with lines, as text.
std::vector<glm::vec3> points_of(const std::string& obj) {
  std::vector<glm::vec3> points;
  std::istringstream text(obj);
  for (std::string line; std::getline(text, line);) {
    glm::vec3 p;
    if (std::sscanf(line.c_str(), "v %f %f %f", &p.x, &p.y, &p.z) == 3) points.push_back(p);
  }
  return points;
}

// Grown fur is written, read as strands of a file, and written again: the points are the same.
TEST_F(Groom, FilesKeepTheirPoints) {
  folder.write("bent.toml", R"toml(model = "torus"
pipeline = "strands"
[[strands.layer]]
count = 2000
curvature = 50
curvature_spread = 40
)toml");
  done("groom bent.toml -o first.hair");
  done("groom bent.toml -o first.obj");
  const std::vector<glm::vec3> first = points_of(folder.read("first.obj"));
  ASSERT_EQ(first.size(), 14000u);
  for (const char* name : {"first.hair", "first.obj"}) {
    const Outcome again = done(fmt::format(
        "groom --model torus --set pipeline=strands --set strands.groom=file --set strands.file={} -o second.obj",
        name));
    expect_has(again.err,
               fmt::format("{}: 2000 strands of 7 points; each moves as a chain of two segments", name));
    EXPECT_EQ(again.out, "second.obj: 2000 strands of 7 points\n");
    const std::vector<glm::vec3> second = points_of(folder.read("second.obj"));
    ASSERT_EQ(second.size(), first.size());
    float worst = 0;
    for (std::size_t i = 0; i < first.size(); ++i)
      worst = std::max(worst, glm::distance(first[i], second[i]));
    EXPECT_LT(worst, tolerance::groom_point) << name;
  }
}

// The strands have the coordinates of a mesh file that is neither at the origin nor of radius 1.
TEST_F(Groom, MayHaveTheCoordinatesOfTheMeshFile) {
  const std::string octahedron =
      "v 15 3 2\nv 5 3 2\nv 10 8 2\nv 10 -2 2\nv 10 3 7\nv 10 3 -3\n"
      "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
  folder.write("eight.obj", octahedron + "v 15.5 3 2\nv 16 3 3\nl 1 7 8\n");
  const std::string scene =
      "--model eight.obj --set pipeline=strands --set strands.groom=file --set strands.file=eight.obj ";
  expect_refused(pelage("groom " + scene + "-o out.obj"), "give strands.file_unit = \"mesh\"", true);
  done("groom " + scene + "--set strands.file_unit=mesh -o out.obj");
  const std::vector<glm::vec3> points = points_of(folder.read("out.obj"));
  ASSERT_EQ(points.size(), 3u);
  EXPECT_LT(glm::distance(points[0], glm::vec3(1, 0, 0)), 1e-5f);
  EXPECT_LT(glm::distance(points[2], glm::vec3(1.2f, 0, 0.2f)), 1e-5f);
}

TEST_F(Groom, ContradictionsAreRefused) {
  folder.write("fur.obj", "v 0 1 0\nv 0 1.2 0\nv 0.1 1.3 0\nl 1 2 3\n");
  const auto refused = [&](const std::string& set, const std::string& message) {
    expect_refused(pelage("render --pipeline strands " + set + " -o out.png"), message, true);
  };
  const std::string file = "--set strands.groom=file --set strands.file=fur.obj ";
  refused("--set strands.groom=file", "\"file\" needs a file with strands; give strands.file");
  refused("--set strands.file=fur.obj", "strands.file: needs strands.groom = \"file\"");
  refused("--set strands.groom=file --set strands.file=none.hair", "none.hair: no such file");
  refused("--set model=none", "model: \"none\" needs strands.groom = \"file\"");
  refused("--set model=none --set strands.file_unit=mesh " + file, "needs a mesh file as the model");
  refused(file + "--set strands.file_unit=mesh",
          "needs the coordinates of a mesh file, but the model is bunny");
  refused("--set model=none --set strands.chain.collision=body " + file, "\"body\" needs a mesh");
  const Outcome alone =
      done("render --pipeline strands --size 160x120 --set model=none --set strands.back_facing=drawn " +
           file + "-o out.png");
  expect_has(alone.err, "fur.obj: 1 strand of 3 points");
  expect_refused(pelage("render --size 160x120 --set model=none " + file + "-o out.png"), "no triangles",
                 true);
}

TEST_F(Groom, OtherFilesAreRefused) {
  expect_refused(pelage("groom straight -o fur.txt"), "fur.txt: strands are written as .hair or .obj");
  expect_refused(pelage("groom straight -o no/fur.obj"), "the folder 'no' does not exist");
}

}  // namespace
}  // namespace pelage::cli
