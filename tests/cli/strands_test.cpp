// Tests the commands with pictures of strands: render, run and report.
#include <set>

#include "harness/compare/metrics.hpp"
#include "harness/picture/image_io.hpp"
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

constexpr const char* few_strands =
    "--model torus --size 240x180 --set dynamics.topology=chains --set dynamics.gravity=[0,-4,0] --set 'strands.layer=[{count=5000,length=0.15}]' ";

struct Strands : InFolder {};

TEST_F(Strands, TheDeviceAndTheReferenceDrawTheSamePicture) {
  for (const std::string pipeline : {"strands", "strands-reference"}) {
    done(fmt::format("render {} --pipeline {} -o {}.exr --dump {}.h5", few_strands, pipeline, pipeline,
                     pipeline));
    EXPECT_TRUE(fs::exists(folder.path / (pipeline + ".h5")));
  }
  const Agreement found =
      compare(read_picture(folder.path / "strands.exr"), read_picture(folder.path / "strands-reference.exr"));
  EXPECT_GT(found.pixels, 5000u);
  EXPECT_TRUE(within(found)) << found.psnr << " dB, " << found.flips << " flips";
}

// A scene names its pipeline, --pipeline overrides it, and a key that the pipeline does not use is named.
TEST(ScenePipeline, DrawsTheSceneAndWarnsOfUnusedKeys) {
  const Folder folder;
  folder.write("furry.toml",
               "model = \"torus-24x12\"\npipeline = \"strands-reference\"\n[image]\nwidth = 64\nheight = 48\n"
               "[[strands.layer]]\ncount = 500\n");
  for (const char* arguments :
       {"furry.toml -o named.png", "furry.toml -o given.png --pipeline strands-reference",
        "furry.toml -o other.png --pipeline reference --set fur.layers=2"}) {
    const Outcome outcome = done(folder, std::string("render ") + arguments);
    EXPECT_EQ(has(outcome.err,
                  "warning: the pipeline reference does not use these keys of the scene: strands.layer\n"),
              has(arguments, "other"))
        << outcome.err;
  }
  EXPECT_EQ(folder.read("named.png"), folder.read("given.png"));
  EXPECT_NE(folder.read("named.png"), folder.read("other.png"));
  expect_refused(pelage(folder, "render furry.toml -o strict.png --strict --set curl.radius=0.1"),
                 "strands-reference does not use these keys of the scene: curl.radius");
  EXPECT_FALSE(fs::exists(folder.path / "strict.png"));
  done(folder, "render furry.toml -o strict.png --strict");
  done(folder, "animate furry.toml -o frames --to 0.05 --fps 20");
  expect_has(folder.read("frames/animation.txt"), "strands-reference");
}

TEST_F(Strands, ChainsAreNoMotionOfShells) {
  for (const std::string pipeline : {"shells", "reference"})
    expect_refused(
        pelage("render --model torus --set dynamics.topology=chains -o a.png --pipeline " + pipeline),
        "dynamics.topology");
}

TEST_F(Strands, TheOpenGlBaselineDrawsTheWholeLook) {
  const auto draw = [&](const std::string& rest) {
    folder.write("mine.toml", "pipeline = \"strands-opengl\"\n[strands]\n" + rest);
    return pelage("render mine.toml -o a.png --model torus-24x12 --size 16x16");
  };
  const Outcome drawn = draw("[[strands.layer]]\ncount = 50\n");
  if (has(drawn.err, "no OpenGL")) GTEST_SKIP() << "there is no OpenGL";
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  for (const char* rest :
       {"fraction = 0.5\n", "[[strands.layer]]\ncount = 50\ntwist_spread = 3\ngloss = 2.0\n"})
    EXPECT_EQ(draw(rest).code, 0);
}

TEST_F(Strands, AnExperimentTimesThemAlone) {
  folder.write(
      "mine.toml",
      "name = \"mine\"\n[axes]\nmodel = [\"torus\"]\ncount = [\"few\", \"more\"]\nvariant = [\"strands\"]\n[scene]\nimage.width = 320\nimage.height = 240\ndynamics.topology = \"chains\"\n[count.few]\nstrands.layer = [{ count = 3000 }]\n[count.more]\nstrands.layer = [{ count = 9000 }]\n[variant.strands]\npipeline = \"strands\"\n[preset.quick]\nwarm_up_s = 0.0\nleast = 9\nmost = 9\nprecision = 0.02\nlimit_s = 20.0\n");
  done("run mine.toml -o rows");
  expect_has(done("export rows --csv -").out, {"simulate", "keys", "sort", "bin", "raster", "frame"});
  done("report rows -o report");
}

// 100 frames have the same bits for three numbers of chunks of the sorted list and for one and two threads.
TEST_F(Strands, FramesHaveTheSameBitsForAllChunksAndThreads) {
  std::set<std::string> hashes;
  for (const char* threads : {"POCL_MAX_PTHREAD_COUNT=1", "POCL_MAX_PTHREAD_COUNT=2"}) {
    const Outcome outcome = done("check --hashes --filter strands", threads);
    const std::vector<std::string> lines = test::lines_of(outcome.out);
    for (const std::string& line : lines) hashes.insert(line.substr(line.rfind(' ') + 1));
    EXPECT_EQ(lines.size(), 3u) << outcome.out;
  }
  EXPECT_EQ(hashes.size(), 1u);
}

}  // namespace
}  // namespace pelage::cli
