// Compares the frames of pelage animate with the pictures of pelage render.
#pragma once
#include <set>

#include "tests/cli/shell.hpp"

namespace pelage::cli {

/// Draws an animation and the picture of each frame with `pelage render`. Expects the same files. Returns the
/// number of different pictures.
inline std::size_t expect_rendered_frames(const Folder& folder, const std::string& scene, double from,
                                          double fps, int count) {
  done(folder, fmt::format("animate {} -o frames --from {} --fps {} --frames {}", scene, from, fps, count));
  const auto frame_of = [](int frame) { return fmt::format("frames/frame-{:05}.png", frame); };
  std::set<std::string> pictures;
  for (int frame = 0; frame < count; ++frame) {
    const auto time = static_cast<float>(from + frame / fps);
    done(folder, fmt::format("render {} --set dynamics.time={} -o one.png", scene, time));
    const std::string picture = folder.read("one.png");
    EXPECT_FALSE(picture.empty());
    EXPECT_TRUE(folder.read(frame_of(frame)) == picture)
        << scene << ", frame " << frame << " at " << time << " s";
    pictures.insert(picture);
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path / frame_of(count)));
  return pictures.size();
}

}  // namespace pelage::cli
