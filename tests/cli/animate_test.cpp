// Tests `pelage animate`: its frames are the pictures of `pelage render`, an interrupted animation is
// continued to the same files, and bad usage is refused.
#include "tests/cli/document.hpp"
#include "tests/cli/frames.hpp"

namespace pelage::cli {
namespace {

const std::string small = " --model torus-16x8 --size 64x48 --set fur.layers=8 --set fur.texture=64";
const std::string wind =
    " --set dynamics.wind.strength=0.02 --set dynamics.wind.gust=1.5 --set dynamics.wind.frequency=2";

struct Animate : InFolder {};

TEST_F(Animate, FramesOfAStillWetSceneAreThoseOfRender) {
  EXPECT_EQ(expect_rendered_frames(folder, "wet" + small, 0, 24, 3), 1u);
}

TEST_F(Animate, FramesOfASceneWithWindAreThoseOfRender) {
  // A simulated frame lasts 1/60 s, so the pictures are 2 or 3 simulated frames apart, or less than one.
  const Folder fast;
  EXPECT_EQ(expect_rendered_frames(folder, "wet-curls" + small + wind, 0.1, 24, 5), 5u);
  const std::size_t different = expect_rendered_frames(fast, "wet-curls" + small + wind, 0.1, 150, 6);
  EXPECT_GT(different, 1u);
  EXPECT_LT(different, 6u);
}

TEST_F(Animate, FramesOfMassSpringsAreThoseOfRender) {
  const Folder adaptive;
  const std::string grass = "grass-waving --size 64x48 --set fur.layers=8";
  EXPECT_EQ(expect_rendered_frames(folder, grass, 0.2, 10, 4), 4u);
  EXPECT_EQ(
      expect_rendered_frames(
          adaptive,
          "grass-return --size 64x48 --set fur.layers=8 --set dynamics.solver=explicit-euler --set dynamics.step=0.001 --set dynamics.substeps=16 --set dynamics.tolerance=0.01",
          0.1, 20, 3),
      3u);
}

TEST_F(Animate, FramesOfAMovingCameraAreThoseOfRender) {
  folder.write("camera.toml",
               "[keyframes]\n\"camera.direction\" = [[0.0, [1.3, 1.15, 2.35]], [1.0, [-1, 0.5, 2]]]\n"
               "\"shading.ambient\" = [[0.0, 0.2], [0.5, 0.6]]\n\"camera.fov\" = [[0.4, 37.0], [1.0, 20.0]]\n"
               "\"image.background\" = [[0.0, [0, 0, 0]], [1.0, [1, 1, 1]]]\n"
               "\"shading.model\" = [[0.0, \"curling\"], [0.8, \"wet\"]]\n");
  EXPECT_EQ(expect_rendered_frames(folder, "camera.toml" + small + wind, 0, 5, 6), 6u);
}

TEST_F(Animate, FramesOfKeyframesThatChangeTheFurAreThoseOfRender) {
  folder.write(
      "fur.toml",
      "[keyframes]\n\"dynamics.wind.strength\" = [[0.0, 0.0], [0.5, 0.02]]\n\"wetness.random\" = [[0, 0], [0.3, 200]]\n\"camera.direction\" = [[0.2, [1, 1, 2]], [0.4, [-1, 1, 2]]]\n");
  EXPECT_EQ(expect_rendered_frames(folder, "fur.toml" + small, 0, 10, 6), 6u);
}

TEST_F(Animate, FramesOfStrandsAreThoseOfRender) {
  folder.write(
      "strands.toml",
      "model = \"torus-16x8\"\nstrands.layer = [{ count = 3000, length = 0.2 }, { count = 500, length = 0.4 }]\n[keyframes]\n\"strands.fraction\" = [[0.0, 1.0], [0.5, 0.2]]\n"
      "\"camera.direction\" = [[0.1, [1, 0, 2]], [0.5, [2, 0, 1]]]\n"
      "\"shading.ambient\" = [[0.0, 0.2], [0.5, 0.4]]\n"
      "\"strands.shadow\" = [[0.0, \"linear\"], [0.35, \"exp\"]]\n");
  const std::string scene = "strands.toml --pipeline strands --size 64x48" + wind;
  EXPECT_EQ(expect_rendered_frames(folder, scene, 0, 10, 6), 6u);
}

TEST_F(Animate, TheOtherPipelinesDrawTheFramesOfRender) {
  EXPECT_EQ(
      expect_rendered_frames(folder, "wet --pipeline reference --mapping tile" + small + wind, 0.1, 10, 2),
      2u);
}

/// The files of two folders, without the time of their last change.
void expect_same_files(const Folder& folder, const std::string& one, const std::string& other) {
  EXPECT_EQ(run_in(folder, fmt::format("diff -r {} {}", one, other)), 0) << folder.read("stdout");
}

const std::string long_animation = "animate wet-curls" + small + wind + " --fps 30 --frames 200 -o ";

TEST_F(Animate, KilledAndContinuedItHasTheSameFiles) {
  done(long_animation + "whole");
  ASSERT_EQ(run_in(folder, fmt::format("pelage {} part & id=$!\n"
                                       "until test -e part/frame-00002.png; do sleep 0.01; done\n"
                                       "kill -9 $id; wait $id || test $? = 137\n",
                                       long_animation)),
            0)
      << folder.read("stderr");
  ASSERT_FALSE(fs::exists(folder.path / "part/frame-00199.png"));
  const std::string first = folder.read("part/frame-00000.png");
  const auto drawn = fs::last_write_time(folder.path / "part/frame-00000.png");
  expect_refused(
      pelage(long_animation + "part"),
      "pelage: part: already contains frames: continue with --resume, or give another folder with -o");
  expect_refused(pelage(long_animation + "part --resume --set fur.length=0.1"),
                 "part/animation.txt: the frames were drawn with \"scene: ");

  expect_has(done(long_animation + "part --resume").err, " kept\n");
  EXPECT_EQ(fs::last_write_time(folder.path / "part/frame-00000.png"), drawn);
  expect_same_files(folder, "whole", "part");
}

TEST_F(Animate, InterruptedItEndsWithItsCodeAndWholeFrames) {
  for (const auto& [signal, code] : {std::pair("INT", 130), std::pair("TERM", 143)}) {
    ASSERT_EQ(run_in(folder, fmt::format("pelage {}{} & id=$!\n"
                                         "until test -e {}/frame-00001.png; do sleep 0.01; done\n"
                                         "kill -{} $id; wait $id || test $? = {}\n",
                                         long_animation, signal, signal, signal, code)),
              0)
        << folder.read("stderr");
    expect_has(folder.read("stderr"), "interrupted; finished frames are kept; continue with --resume");
    done(long_animation + signal + " --resume");
  }
  expect_same_files(folder, "INT", "TERM");
}

TEST_F(Animate, ALongerAnimationKeepsTheFrames) {
  const std::string scene = "animate wet-curls" + small + wind + " -o frames --fps 10 ";
  done(scene + "--to 0.3");
  expect_has(done(scene + "--to 0.5 --resume").err,
             {"frames: 2 frames drawn, 4 kept", "5/6 frame-00004.png, 0.400 s: drawn in "});
}

TEST_F(Animate, RefusesBadUsageBeforeItDraws) {
  folder.write("size.toml", "[keyframes]\n\"image.width\" = [[0, 64], [1, 96]]\n");
  folder.write("file", "");
  const std::pair<const char*, const char*> refused[] = {
      {"animate wet", "--output is required"},
      {"animate wet -o f", "the scene has no keyframes that say when the animation ends"},
      {"animate wet -o f --to 1 --frames 3", "give --to or --frames, but not both"},
      {"animate wet -o '' --to 1", "the name of the folder for the frames is empty"},
      {"animate wet -o f --to -1", "--to -1: give a time of 0 to 3600 s"},
      {"animate wet -o f --frames 0", "an animation of 0 frames"},
      {"animate wet -o f --fps 0 --to 1", "--fps 0: give a number above 0"},
      {"animate wet -o f --to 1 --set dynamics.time=3",
       "--set dynamics.time=3: every frame has its own time"},
      {"animate wet -o file --to 1", "file: is not a folder"},
      {"animate size.toml -o f --to 1", "all frames must have one size"},
      {"animate wet -o f --to 1 --gif no/a.gif", "no/a.gif: cannot be written"},
      {"animate wet -o f --to 1 --pipeline magic", "--pipeline"},
      {"animate wet -o f --to 1 --reference-bits 8", "add --pipeline reference"},
  };
  for (const auto& [arguments, message] : refused) expect_refused(pelage(arguments), message);
  EXPECT_FALSE(fs::exists(folder.path / "f"));
}

/// Makes a folder of programs in which `ffmpeg` writes its arguments to the file `arguments`, and the text
/// "video" to the file that its last argument names. Returns the environment in which pelage finds it.
std::string with_fake_ffmpeg(const Folder& folder) {
  fs::create_directory(folder.path / "bin");
  const std::string bin = (folder.path / "bin").string();
  folder.write("bin/ffmpeg", "#!/bin/sh\nprintf '%s\\n' \"$PWD\" \"$@\" >>'" + folder.path.string() +
                                 "/arguments'\nfor file; do :; done\nprintf video >\"$file\"\n");
  fs::permissions(folder.path / "bin/ffmpeg", fs::perms::owner_all);
  return fmt::format("PATH='{}:{}'", bin, std::getenv("PATH"));
}

TEST_F(Animate, JoinsTheFramesWithFfmpeg) {
  const std::string path = with_fake_ffmpeg(folder);
  const std::string scene = "animate wet" + small + " -o frames --frames 3 --fps 60 ";
  done(scene + "--gif a.gif --mp4 frames/a.mp4", path);
  EXPECT_EQ(folder.read("a.gif"), "video");
  EXPECT_EQ(folder.read("frames/a.mp4"), "video");
  const std::string arguments = folder.read("arguments");
  for (const char* part : {"/frames\n", "\n-framerate\n60\n", "\n-i\nframe-%05d.png\n",
                           "\ntrim=end_frame=3,fps=50,split[a][b];[a]palettegen[p];[b][p]paletteuse\n",
                           "\ntrim=end_frame=3,pad=ceil(iw/2)*2:ceil(ih/2)*2\n", "\nyuv420p\n"})
    expect_has(arguments, part);

  // If ffmpeg fails, its last message is shown, and the former file stays.
  folder.write("bin/ffmpeg", "#!/bin/sh\necho first; echo no space left >&2; exit 4\n");
  const Outcome failed = pelage(scene + "--resume --gif a.gif", path);
  EXPECT_EQ(failed.code, 1);
  expect_has(failed.err, "a.gif: ffmpeg failed with the exit code 4: no space left");
  EXPECT_EQ(folder.read("a.gif"), "video");
}

TEST_F(Animate, WithoutFfmpegAVideoIsRefusedBeforeItDraws) {
  fs::create_directory(folder.path / "bin");
  ASSERT_EQ(run_in(folder, "ln -s \"$(command -v timeout)\" bin/timeout"), 0);
  const std::string path = fmt::format("PATH='{}'", (folder.path / "bin").string());
  for (const char* option : {"--gif a.gif", "--mp4 a.mp4"}) {
    expect_refused(
        pelage(fmt::format("animate wet {} -o frames --frames 2 {}", small, option), path),
        fmt::format(
            "pelage: {}: needs the program ffmpeg, which is not installed (Debian package: ffmpeg); frames need no ffmpeg",
            option));
    EXPECT_FALSE(fs::exists(folder.path / "frames"));
  }
}

}  // namespace
}  // namespace pelage::cli
