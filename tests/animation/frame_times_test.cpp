#include "harness/animation/animation.hpp"
#include "harness/scene/scene_toml.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

const char* const moving =
    "[keyframes]\n\"camera.fov\" = [[0.5, 30.0], [1.25, 60.0]]\n\"dynamics.time\" = [[0, 0.0], [9, 1.0]]\n";

Scene scene_of(const std::string& text) {
  return parse_scene(text, "scene.toml");
}

std::string frames_refusal(const TimeOptions& options, const std::string& scene = "") {
  return test::refusal([&] { check_frames(scene_of(scene), frame_times(options, scene_of(scene))); }, "");
}

TEST(FrameTimes, TheLastFrameIsAtTheEnd) {
  const FrameTimes times = frame_times({.fps = 24, .to = 2}, {});
  EXPECT_EQ(times.count, 49);
  EXPECT_EQ(times.at(0), 0.0f);
  EXPECT_EQ(times.at(24), 1.0f);  // not 1 minus the rounding errors of 24 additions
  EXPECT_EQ(times.at(48), 2.0f);
  EXPECT_EQ(times.at(1), static_cast<float>(1.0 / 24));
}

TEST(FrameTimes, TheEndLiesBetweenTwoFrames) {
  EXPECT_EQ(frame_times({.fps = 10, .from = 1, .to = 1.35}, {}).count, 4);
  EXPECT_EQ(frame_times({.fps = 10, .from = 1, .to = 1.35}, {}).at(3), 1.3f);
}

TEST(FrameTimes, RoundingErrorsDropNoFrame) {
  // 0.29 * 100 and (1.1 - 0.8) * 10 are slightly below 29 and 3.
  EXPECT_EQ(frame_times({.fps = 100, .to = 0.29}, {}).count, 30);
  EXPECT_EQ(frame_times({.fps = 10, .from = 0.8, .to = 1.1}, {}).count, 4);
}

TEST(FrameTimes, WithoutAnEndTheLastKeyframeIsTheEnd) {
  EXPECT_EQ(frame_times({.fps = 4}, scene_of(moving)).count, 6);
  EXPECT_EQ(frame_times({.fps = 4}, scene_of(moving)).at(5), 1.25f);
  EXPECT_EQ(frame_times({.fps = 4, .to = 2}, scene_of(moving)).count, 9);
  EXPECT_EQ(frame_times({.fps = 4, .frames = 3}, scene_of(moving)).count, 3);
}

TEST(FrameTimes, RefusesWhatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string none = frames_refusal({});
  test::expect_has(none, {"no keyframes", "--to SECONDS"});
  // Keyframes of dynamics.time have no effect, so they give no end.
  EXPECT_EQ(frames_refusal({}, "[keyframes]\n\"dynamics.time\" = [[0, 0.0], [9, 1.0]]\n"), none);
  EXPECT_EQ(frames_refusal({.to = 1, .frames = 3}), "give --to or --frames, but not both");
  EXPECT_EQ(frames_refusal({.fps = 0, .to = 1}), "--fps 0: give a number above 0 and at most 1000");
  EXPECT_EQ(frames_refusal({.fps = nan, .to = 1}), "--fps nan: give a number above 0 and at most 1000");
  EXPECT_EQ(frames_refusal({.fps = 1001, .to = 1}), "--fps 1001: give a number above 0 and at most 1000");
  EXPECT_EQ(frames_refusal({.from = -1, .to = 1}), "--from -1: give a time of 0 to 3600 s");
  EXPECT_EQ(frames_refusal({.to = 3601}), "--to 3601: give a time of 0 to 3600 s");
  EXPECT_EQ(frames_refusal({.to = nan}), "--to nan: give a time of 0 to 3600 s");
  EXPECT_EQ(frames_refusal({.from = 2, .to = 1}),
            "--from 2: the first frame is after the last one, which is at 1 s");
  EXPECT_EQ(
      frames_refusal({.from = 2}, moving),
      "--from 2: the first frame is after the last one, which is at 1.25 s, the time of the last keyframe");
  EXPECT_EQ(frames_refusal({.frames = 0}), "an animation of 0 frames; it must have 1 to 100000");
  EXPECT_EQ(frames_refusal({.fps = 1000, .to = 3600}),
            "an animation of 3600001 frames; it must have 1 to 100000");
  EXPECT_EQ(frames_refusal({.fps = 1, .from = 3599, .frames = 3}),
            "--frames 3: the last frame is at 3601 s; its time must be at most 3600 s");
  EXPECT_EQ(frames_refusal({.fps = 1, .from = 3599, .frames = 2}), "");
}

TEST(FrameTimes, AllFramesHaveOneSize) {
  test::expect_has(
      frames_refusal({.fps = 1, .to = 3}, "[keyframes]\n\"image.width\" = [[0, 800], [2, 640]]\n"),
      "the frame at 2 s has 640x600 pixels and the first frame 800x600");
}

TEST(FrameTimes, ASceneThatIsNotValidAtTheTimeOfAFrameIsRefused) {
  const std::string opposite = "[keyframes]\n\"camera.direction\" = [[0, [1, 0, 0]], [2, [-1, 0, 0]]]\n";
  EXPECT_EQ(frames_refusal({.fps = 0.5}, opposite), "");
  test::expect_has(frames_refusal({.fps = 1}, opposite), "camera.direction");
}

}  // namespace
}  // namespace pelage
