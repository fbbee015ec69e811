#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <iterator>
#include <random>
#include <thread>

#include "harness/animation/animation.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

const FrameOrigin origin{{"scene", "12"}, {"frames per second", "24"}};

struct FrameFolders : test::InFolder {
  const fs::path place = folder.path;
};

/// A picture whose content depends on the number of the frame.
Picture picture(int frame) {
  Picture made{24, 16, std::vector<glm::vec4>(384)};
  for (std::size_t i = 0; i < made.pixel.size(); ++i)
    made.pixel[i] = glm::vec4(float((i * 7 + std::size_t(frame) * 31) % 255) / 255.0f);
  return made;
}

std::string refusal(const fs::path& folder, bool resume, const FrameOrigin& from = origin) {
  return test::refusal([&] { FrameFolder(folder, from, resume); });
}

TEST_F(FrameFolders, RecordsTheFramesAndWhatTheyWereDrawnFrom) {
  FrameFolder drawn(place / "new/frames", origin, false);
  EXPECT_FALSE(drawn.holds(0));
  drawn.write(0, picture(0));
  drawn.write(12, picture(12));
  EXPECT_TRUE(drawn.holds(0));
  EXPECT_TRUE(drawn.holds(12));
  EXPECT_FALSE(drawn.holds(1));
  EXPECT_TRUE(fs::exists(place / "new/frames/frame-00012.png"));
  const std::string record = folder.read("new/frames/animation.txt");
  EXPECT_EQ(record.find("pelage animation 1\nscene: 12\nframes per second: 24\nframes:\n0 "), 0u) << record;
}

TEST_F(FrameFolders, AnEmptyFolderIsAcceptedWithAndWithoutResume) {
  for (const bool resume : {false, true}) EXPECT_EQ(refusal(place / ".", resume), "accepted");
}

TEST_F(FrameFolders, FramesAreContinuedOnlyWithResumeAndTheSameOrigin) {
  FrameFolder(place / "f", origin, false).write(0, picture(0));
  test::expect_has(refusal(place / "f", false), "already contains frames: continue with --resume");
  EXPECT_EQ(refusal(place / "f", true), "accepted");
  test::expect_has(refusal(place / "f", true, {{"scene", "12"}, {"frames per second", "30"}}),
                   "drawn with \"frames per second: 24\", which is now \"frames per second: 30\"");
  test::expect_has(refusal(place / "f", true, {{"scene", "12"}}), "animation.txt: ");
  EXPECT_TRUE(FrameFolder(place / "f", origin, true).holds(0));
}

TEST_F(FrameFolders, OnlyWholeFramesAreKept) {
  {
    FrameFolder drawn(place / "f", origin, false);
    for (int frame = 0; frame < 4; ++frame) drawn.write(frame, picture(frame));
  }
  const std::string first = folder.read("f/frame-00001.png"), record = folder.read("f/animation.txt");
  folder.write("f/frame-00001.png", first.substr(0, first.size() - 1));
  folder.write("f/frame-00002.png", folder.read("f/frame-00003.png"));
  fs::remove(place / "f/frame-00003.png");
  FrameFolder drawn(place / "f", origin, true);
  EXPECT_TRUE(drawn.holds(0));
  for (int frame = 1; frame < 4; ++frame) EXPECT_FALSE(drawn.holds(frame)) << frame;
  drawn.write(1, picture(1));
  EXPECT_TRUE(drawn.holds(1));
  EXPECT_EQ(folder.read("f/frame-00001.png"), first);
  EXPECT_EQ(folder.read("f/animation.txt"), record);
}

TEST_F(FrameFolders, WhatAKilledProcessLeavesIsRemoved) {
  {
    FrameFolder drawn(place / "f", origin, false);
    for (int frame = 0; frame < 2; ++frame) drawn.write(frame, picture(frame));
  }
  const std::string record = folder.read("f/animation.txt");
  folder.write("f/animation.txt", record.substr(0, record.size() - 5));
  folder.write("f/.frame-00002.4711.png", "half a picture");
  FrameFolder drawn(place / "f", origin, true);
  EXPECT_TRUE(drawn.holds(0));
  EXPECT_FALSE(drawn.holds(1));
  EXPECT_FALSE(fs::exists(place / "f/.frame-00002.4711.png"));
  drawn.write(1, picture(1));
  EXPECT_EQ(folder.read("f/animation.txt"), record);
}

TEST_F(FrameFolders, RefusesFoldersThatItCannotContinue) {
  folder.write("file", "text");
  test::expect_has(refusal(place / "file", false), "is not a folder");
  test::expect_has(refusal(place / "file/f", false), "cannot be created");
  fs::create_directory(place / "foreign");
  folder.write("foreign/frame-00000.png", "picture");
  test::expect_has(refusal(place / "foreign", false), "already contains frames");
  test::expect_has(refusal(place / "foreign", true), "contains frames, but no animation.txt");
  folder.write("foreign/animation.txt", "");
  test::expect_has(refusal(place / "foreign", true), "animation.txt: is damaged");
  folder.write("foreign/animation.txt",
               "pelage animation 1\nscene: 12\nframes per second: 24\nframes:\nx 12\n");
  test::expect_has(refusal(place / "foreign", true), "\"x 12\" is not the number of a frame and its hash");
}

TEST_F(FrameFolders, OneProcessAtATimeDrawsToAFolder) {
  const FrameFolder first(place / "f", origin, false);
  test::expect_has(refusal(place / "f", true), "another pelage process draws to this folder");
}

TEST_F(FrameFolders, KilledAndContinuedItHoldsTheSameFiles) {
  constexpr int frames = 40;
  const auto draw = [&](const std::string& name) {
    FrameFolder drawn(place / name, origin, true);
    for (int frame = 0; frame < frames; ++frame)
      if (!drawn.holds(frame)) drawn.write(frame, picture(frame));
  };
  draw("whole");
  std::mt19937_64 random(20261126);
  int interrupted = 0;
  for (int moment = 0; moment < 40; ++moment) {
    const std::string name = "killed-" + std::to_string(moment);
    const pid_t child = fork();
    if (child == 0) {
      draw(name);
      _exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 12000));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    interrupted += WIFSIGNALED(status) && fs::exists(place / (name + "/frame-00000.png"));
    draw(name);
    for (const auto& entry : fs::directory_iterator(place / "whole")) {
      const std::string file = entry.path().filename().string();
      EXPECT_EQ(folder.read(fs::path(name) / file), folder.read("whole/" + file)) << name << " " << file;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(place / name), fs::directory_iterator()), frames + 1);
  }
  EXPECT_GE(interrupted, 5) << "too few of the kills hit a folder with frames";
}

}  // namespace
}  // namespace pelage
