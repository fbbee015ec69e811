// Tests `pelage diagram`, the option --case, and the pages of the papers' figures.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <set>
#include <sstream>

#include "harness/picture/image_io.hpp"
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

TEST(Figures, OneFigureIsRunAndAgreesWithTheReference) {
  const Folder folder;
  const Outcome run = pelage(folder, "run silva2010-fig08 --preset smoke --axis figure=wet -o run");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("1 cases ok, 0 cases not ok"), std::string::npos) << run.err;
  const Picture picture = read_picture(folder.path() / "run/silva2010-fig08/images/wet-160x120.png");
  EXPECT_EQ(picture.width, 160);

  // --case selects the same scene, so the same device draws the same picture.
  const Outcome render =
      pelage(folder, "render silva2010-fig08 --case wet-640x480 --size 160x120 -o again.png");
  ASSERT_EQ(render.code, 0) << render.err;
  const Picture again = read_picture(folder.path() / "again.png");
  ASSERT_EQ(again.pixel.size(), picture.pixel.size());
  const auto same = [](const glm::vec4& a, const glm::vec4& b) { return glm::vec3(a) == glm::vec3(b); };
  EXPECT_TRUE(std::equal(picture.pixel.begin(), picture.pixel.end(), again.pixel.begin(), same));
}

TEST(Figures, TheCollectionNamesAllTheirCases) {
  const Folder folder;
  const Outcome dry = pelage(folder, "run figures --dry-run");
  ASSERT_EQ(dry.code, 0) << dry.err;
  EXPECT_NE(dry.out.find("silva2010-fig13\tnear-640x480"), std::string::npos) << dry.out;
  EXPECT_NE(dry.out.find("wetfur2010-fig06\tc-640x480"), std::string::npos) << dry.out;
  // The pages show only cases that exist, and all of them.
  ASSERT_EQ(std::system(("'" PELAGE_SOURCE_DIR "/scripts/figure_sheets.py' --list >'" +
                         folder.path().string() + "/list'")
                            .c_str()),
            0);
  std::istringstream list(folder.read("list")), cases(dry.out);
  std::set<std::string> shown, known;
  for (std::string experiment, name, kind; list >> experiment >> name >> kind;) {
    EXPECT_NE(dry.out.find(fmt::format("{}\t{}\t", experiment, name)), std::string::npos)
        << experiment << " " << name;
    // The diagrams `lines` and `wind` contain the picture of the case.
    if (kind == "picture" || kind == "lines" || kind == "wind")
      shown.insert(fmt::format("{} {}", experiment, name));
  }
  for (std::string line; std::getline(cases, line);) {
    std::istringstream words(line);
    std::string experiment, name;
    words >> experiment >> name;
    known.insert(fmt::format("{} {}", experiment, name));
  }
  EXPECT_EQ(shown, known);
}

TEST(Diagrams, MasksShowTheTextAndNothingElse) {
  const Folder folder;
  const Outcome outcome = pelage(
      folder,
      "diagram mask wet-text --set wetness.text=I --set wetness.text_height=0.4 --side 256 -o mask.png");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Picture mask = read_picture(folder.path() / "mask.png");
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

TEST(Diagrams, SectionsAreTablesAndPlots) {
  const Folder folder;
  const Outcome table = pelage(folder, "diagram shape --set fur.layers=4");
  ASSERT_EQ(table.code, 0) << table.err;
  EXPECT_EQ(table.out.substr(0, table.out.find('\n')), "w,h,f");
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 1 + 5 * 4);
  for (const char* kind : {"shape", "clump", "curl", "layers"}) {
    const std::string name = kind;
    const Outcome plot = pelage(
        folder,
        fmt::format("diagram {0} --model torus --set fur.layers=4 --set curl.radius=0.02 -o {0}.svg", name));
    ASSERT_EQ(plot.code, 0) << plot.err;
    EXPECT_NE(folder.read(name + ".svg").find("<svg"), std::string::npos);
    EXPECT_FALSE(folder.read(name + ".csv").empty());
  }
}

TEST(Diagrams, StrandsAreWhiteLinesOverTheFur) {
  const Folder folder;
  const std::string scene = "silva2010-fig04 --case triangle-640x480 --size 160x120 ";
  ASSERT_EQ(pelage(folder, "render " + scene + "-o fur.png").code, 0);
  const Outcome outcome = pelage(folder, "diagram lines " + scene + "-o strands.png --line-width 3");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Picture fur = read_picture(folder.path() / "fur.png"),
                lines = read_picture(folder.path() / "strands.png");
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
