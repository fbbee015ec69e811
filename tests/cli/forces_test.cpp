// Tests keyframes of forces in the commands: the pictures do not depend on the frame rate, and a scene that
// does not permit a force of another time is refused.
#include "tests/cli/document.hpp"
#include "tests/cli/frames.hpp"

namespace pelage::cli {
namespace {

const std::string gusts =
    "[keyframes]\n\"dynamics.wind.strength\" = [[0.0, 0.03], [0.2, 0.03], [0.201, 0.0]]\n"
    "\"dynamics.wind.direction\" = [[0.0, [1, 0, 0.2]], [0.3, [0, 0.5, 1]]]\n";
const std::string scene = "forces.toml --model torus-16x8 --size 64x48 ";

struct ForceFrames : InFolder {
  std::string file(const std::string& folder_of_frames, int frame) const {
    return folder.read(fmt::format("{}/frame-{:05}.png", folder_of_frames, frame));
  }
};

TEST_F(ForceFrames, DoNotDependOnTheFrameRate) {
  const std::string layers = "fur.layers = 8\nfur.texture = 64\n";
  const std::string poke =
      "\"dynamics.poke.radius\" = [[0.0, 0.6]]\n\"dynamics.poke.force\" = [[0.0, [0, 0, 0.1]], [0.3, [0, 0, 0]]]\n"
      "\"dynamics.poke.point\" = [[0.0, [0, 0, 1]], [0.3, [1, 0, 0]]]\n";
  const auto on = [&](const char* topology) {
    return fmt::format("{}dynamics.drag = 0.004\ndynamics.topology = \"{}\"\n{}{}", layers, topology, gusts,
                       poke);
  };
  int number = 0;
  for (const std::string& text :
       {layers + gusts, on("sticks"), on("prisms"), on("separable-prisms"),
        "pipeline = \"strands\"\nstrands.layer = [{ count = 2000, length = 0.2 }]\n" + gusts}) {
    folder.write("forces.toml", text);
    const std::string slow = fmt::format("slow{}", number), fast = fmt::format("fast{}", number);
    ++number;
    done(fmt::format("animate {}--fps 24 --to 0.5 -o {}", scene, slow));
    done(fmt::format("animate {}--fps 60 --to 0.5 -o {}", scene, fast));
    std::set<std::string> pictures;
    for (int k = 0; k <= 12; k += 2) {  // k / 24 s = 5 k / 2 / 60 s
      const std::string picture = file(slow, k);
      EXPECT_FALSE(picture.empty());
      EXPECT_TRUE(picture == file(fast, 5 * k / 2)) << text << k;
      pictures.insert(picture);
      if (k % 4 != 0) continue;
      done(fmt::format("render {} --set dynamics.time={} -o one.png", scene, float(k / 24.0)));
      EXPECT_TRUE(picture == folder.read("one.png")) << text << k;
    }
    EXPECT_EQ(pictures.size(), 7u) << text;
  }
}

TEST_F(ForceFrames, AreRefusedIfTheyPointNowhere) {
  folder.write("forces.toml",
               "dynamics.step = 0.0078125\n[keyframes]\n"
               "\"dynamics.wind.direction\" = [[0, [1, 0, 0]], [1, [-1, 0, 0]]]\n");
  expect_refused(pelage("animate " + scene + "-o f"),
                 "pelage: keyframes at 0.5 s: dynamics.wind.direction: points nowhere");
  EXPECT_FALSE(fs::exists(folder.path / "f"));
  done("animate " + scene + "-o f --to 0.4");
}

TEST_F(ForceFrames, OnStrandsNeedDragAtTheTimeOfThePicture) {
  folder.write("forces.toml",
               "pipeline = \"strands\"\nstrands.layer = [{ count = 300, length = 0.2 }]\n[keyframes]\n"
               "\"strands.chain.drag\" = [[0.0, 1.0], [1.0, 0.0]]\n"
               "\"dynamics.wind.strength\" = [[0.0, 0.03], [0.9, 0.0]]\n");
  done("render " + scene + "--set dynamics.time=0.9 -o one.png");
  expect_refused(pelage("render " + scene + "--set dynamics.time=1 -o one.png"),
                 "dynamics.wind.strength: the wind has no effect on strands without drag", true);
}

TEST_F(ForceFrames, MakeAPathThatReturns) {
  const std::string wind =
      "[keyframes]\n\"dynamics.wind.strength\" = [[0.0, 0.03], [1.0, 0.03], [1.001, 0.0]]\n";
  const std::string sticks =
      "dynamics.springs.return_weight = 0.4\ndynamics.drag = 0.004\ndynamics.topology = \"sticks\"\n";
  for (const std::string& text :
       {wind, sticks + wind,
        "pipeline = \"strands\"\nstrands.layer = [{ count = 2000, length = 0.2 }]\n" + wind}) {
    folder.write("forces.toml", text);
    const Outcome path = done("diagram path forces.toml --model torus-16x8 --set dynamics.time=6 --most 20");
    const std::vector<std::string> lines = test::lines_of(path.out);
    ASSERT_EQ(lines.size(), 1u + 361u);
    EXPECT_EQ(lines[0], "t,x,y,rest_x,rest_y,apart");
    const auto apart = [&](std::size_t frame) {
      const std::string& line = lines[1 + frame];
      return std::stod(line.substr(line.rfind(',') + 1));
    };
    EXPECT_GT(apart(59), 0.1) << text;
    EXPECT_LT(apart(360), 0.02) << text;
  }
}

}  // namespace
}  // namespace pelage::cli
