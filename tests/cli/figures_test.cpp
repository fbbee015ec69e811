// Tests `pelage diagram`, the option --case, and the collection of the papers' figures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include "harness/picture/image_io.hpp"
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

struct Figures : InFolder {};

TEST_F(Figures, OneFigureIsRunAndAgreesWithTheReference) {
  const Outcome run = done("run silva2010-fig08 --preset smoke --axis figure=wet -o run");
  expect_has(run.err, "1 cases ok, 0 cases not ok");
  const Picture picture = read_picture(folder.path / "run/silva2010-fig08/images/wet-160x120.png");
  EXPECT_EQ(picture.width, 160);

  // --case selects the same scene, so the same device draws the same picture.
  done("render silva2010-fig08 --case wet-640x480 --size 160x120 -o again.png");
  const Picture again = read_picture(folder.path / "again.png");
  ASSERT_EQ(again.pixel.size(), picture.pixel.size());
  const auto same = [](const glm::vec4& a, const glm::vec4& b) { return glm::vec3(a) == glm::vec3(b); };
  EXPECT_TRUE(std::equal(picture.pixel.begin(), picture.pixel.end(), again.pixel.begin(), same));
}

TEST_F(Figures, TheCollectionNamesAllTheirCases) {
  expect_has(done("run figures --dry-run").out,
             {"silva2010-fig13\tnear-640x480", "wetfur2010-fig06\tc-640x480"});
}

struct Diagrams : InFolder {};

TEST_F(Diagrams, MasksShowTheTextAndNothingElse) {
  done("diagram mask wet-text --set wetness.text=I --set wetness.text_height=0.4 --side 256 -o mask.png");
  const Picture mask = read_picture(folder.path / "mask.png");
  ASSERT_EQ(mask.width, 256);
  int inside = 0, outside = 0;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const glm::vec4& p = mask.at(x, y);
      if (!(p.z > 2 * p.x + 0.1f)) continue;  // not blue
      // The letter I is a vertical bar in the middle; droplets reach beyond it by their radius.
      const bool near = std::abs(x - 128) < 40 && std::abs(y - 128) < 75;
      ++(near ? inside : outside);
    }
  EXPECT_GT(inside, 1000);
  EXPECT_EQ(outside, 0);
}

TEST_F(Diagrams, SectionsAreTablesAndPlots) {
  const Outcome table = done("diagram shape --set fur.layers=4");
  EXPECT_EQ(table.out.substr(0, table.out.find('\n')), "w,h,f");
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 1 + 5 * 4);
  for (const char* kind : {"shape", "clump", "curl", "layers", "path"}) {
    const std::string name = kind;
    done(fmt::format("diagram {0} --model torus --set fur.layers=4 --set curl.radius=0.02 -o {0}.svg", name));
    expect_has(folder.read(name + ".svg"), "<svg");
    EXPECT_FALSE(folder.read(name + ".csv").empty());
  }
}

TEST_F(Diagrams, StrandsAreWhiteLinesOverTheFur) {
  const std::string scene = "silva2010-fig04 --case triangle-640x480 --size 160x120 ";
  done("render " + scene + "-o fur.png");
  done("diagram lines " + scene + "-o strands.png --line-width 3");
  const Picture fur = read_picture(folder.path / "fur.png"),
                lines = read_picture(folder.path / "strands.png");
  int white = 0, other = 0;
  for (std::size_t i = 0; i < fur.pixel.size(); ++i) {
    if (glm::vec3(fur.pixel[i]) == glm::vec3(lines.pixel[i])) continue;
    // A pixel of the line is brighter than the fur; only the line's border keeps some of the fur's colour.
    ++(lines.pixel[i].z >= fur.pixel[i].z ? white : other);
  }
  EXPECT_GT(white, 60);
  EXPECT_EQ(other, 0);
}

}  // namespace
}  // namespace pelage::cli
