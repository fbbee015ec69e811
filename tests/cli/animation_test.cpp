// Runs the commands of docs/animation.md with a smaller picture and fewer frames.
#include <gtest/gtest.h>

#include <set>

#include "tests/cli/document.hpp"

namespace pelage::cli {
namespace {

namespace fs = std::filesystem;

/// Replaces `from` by `to` in `text` and returns the result. `text` must contain `from` exactly once.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at == std::string::npos) return text;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Animation, TheLoopDrawsFramesThatMoveAndJoin) {
  const Folder folder;
  const auto blocks = blocks_of(fs::path(PELAGE_SOURCE_DIR) / "docs/animation.md");
  ASSERT_EQ(blocks.size(), 5u);
  ASSERT_EQ(blocks[3].language, "toml");  // the keyframes of a scene
  folder.write("keyframes.toml", blocks[3].text);
  EXPECT_EQ(pelage(folder, "scene keyframes.toml").code, 0) << folder.read("stderr");
  std::string loop = replaced(blocks[0].text, "--size 800x600", "--size 96x72 --set fur.layers=8");
  loop = replaced(loop, "seq 0 59", "seq 0 3");
  loop = replaced(loop, "$i / 30", "$i / 5");  // with 0.2 s between frames, all frames differ
  ASSERT_EQ(run_in(folder, loop), 0) << folder.read("stderr");
  std::set<std::string> pictures;
  for (const char* frame : {"0000", "0001", "0002", "0003"})
    pictures.insert(folder.read("frames/" + std::string(frame) + ".png"));
  EXPECT_EQ(pictures.size(), 4u);
  EXPECT_FALSE(pictures.contains(""));

  if (std::system("command -v ffmpeg >/dev/null") != 0)
    GTEST_SKIP() << "ffmpeg is not installed, so the frames are not joined";
  ASSERT_EQ(run_in(folder, blocks[1].text), 0) << folder.read("stderr");
  EXPECT_GT(fs::file_size(folder.path() / "grass.mp4"), 500u);
  ASSERT_EQ(run_in(folder, blocks[2].text), 0) << folder.read("stderr");
  EXPECT_GT(fs::file_size(folder.path() / "grass.gif"), 500u);
}

}  // namespace
}  // namespace pelage::cli
