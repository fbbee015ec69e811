// Runs the commands of docs/meshes.md with a smaller picture and fewer frames.
#include <set>

#include "tests/cli/document.hpp"

namespace pelage::cli {
namespace {

/// Returns the command with 4 small frames. With 0.2 s between frames, all frames differ.
std::string smaller(const std::string& command) {
  std::string text = test::replaced(command, "--size 800x600", "--size 96x72 --set fur.layers=8");
  text = test::replaced(text, "--fps 30", "--fps 5");
  return test::replaced(text, "--frames 60", "--frames 4");
}

std::size_t different(const Folder& folder, const std::string& frames, int count) {
  std::set<std::string> pictures;
  for (int frame = 0; frame < count; ++frame) {
    pictures.insert(folder.read(frames + "/frame-0000" + std::to_string(frame) + ".png"));
    EXPECT_FALSE(pictures.contains(""));
  }
  return pictures.size();
}

TEST(Animation, TheCommandsDrawFramesThatMoveAndJoin) {
  const Folder folder;
  const auto blocks = blocks_of(fs::path(PELAGE_SOURCE_DIR) / "docs/meshes.md");
  ASSERT_EQ(blocks.size(), 5u);
  const bool ffmpeg = std::system("command -v ffmpeg >/dev/null") == 0;
  for (const std::size_t block : {0u, 1u}) {
    std::string command = smaller(blocks[block].text);
    if (!ffmpeg) command = test::replaced(command, " --gif grass.gif --mp4 grass.mp4", "");
    ASSERT_EQ(run_in(folder, command), 0) << folder.read("stderr");
    EXPECT_EQ(different(folder, "frames", 4), 4u);
  }
  expect_has(folder.read("stderr"), "0 frames drawn, 4 kept");  // with --resume

  ASSERT_EQ(blocks[2].language, "toml");  // the keyframes of a scene
  folder.write("keyframes.toml", blocks[2].text + "[strands]\nlayer = [{ count = 2000, length = 0.2 }]\n");
  ASSERT_EQ(run_in(folder, test::replaced(blocks[3].text, "strands -o",
                                          "strands --model torus-16x8 --size 48x36 --fps 1 -o")),
            0)
      << folder.read("stderr");
  EXPECT_EQ(different(folder, "keyframes", 6), 6u);

  if (!ffmpeg) GTEST_SKIP() << "ffmpeg is not installed, so the frames are not joined";
  EXPECT_EQ(folder.read("grass.gif").substr(0, 6), "GIF89a");
  EXPECT_GT(fs::file_size(folder.path / "grass.gif"), 500u);
  EXPECT_EQ(folder.read("grass.mp4").substr(4, 4), "ftyp");
  EXPECT_GT(fs::file_size(folder.path / "grass.mp4"), 500u);
}

}  // namespace
}  // namespace pelage::cli
