#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <iterator>
#include <random>
#include <thread>

#include "harness/animation/animation.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

const FrameOrigin origin{{"scene", "12"}, {"frames per second", "24"}};

struct Place : test::Folder {
  fs::path operator/(const std::string& name) const { return path / name; }
  std::string read(const fs::path& name) const { return test::text_of(path / name); }
  void write(const std::string& name, const std::string& text) const { test::write_text(path / name, text); }
};

/// A picture whose content depends on the number of the frame.
Picture picture(int frame) {
  Picture made{24, 16, std::vector<glm::vec4>(384)};
  for (std::size_t i = 0; i < made.pixel.size(); ++i)
    made.pixel[i] = glm::vec4(float((i * 7 + std::size_t(frame) * 31) % 255) / 255.0f);
  return made;
}

std::string refusal(const fs::path& folder, bool resume, const FrameOrigin& from = origin) {
  return test::refusal([&] { FrameFolder(folder, from, resume); }, "");
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(FrameFolder, RecordsTheFramesAndWhatTheyWereDrawnFrom) {
  const Place place;
  FrameFolder folder(place / "new/frames", origin, false);
  EXPECT_FALSE(folder.holds(0));
  folder.write(0, picture(0));
  folder.write(12, picture(12));
  EXPECT_TRUE(folder.holds(0));
  EXPECT_TRUE(folder.holds(12));
  EXPECT_FALSE(folder.holds(1));
  EXPECT_TRUE(fs::exists(place / "new/frames/frame-00012.png"));
  const std::string record = place.read("new/frames/animation.txt");
  EXPECT_EQ(record.find("pelage animation 1\nscene: 12\nframes per second: 24\nframes:\n0 "), 0u) << record;
}

TEST(FrameFolder, AnEmptyFolderIsAcceptedWithAndWithoutResume) {
  for (const bool resume : {false, true}) {
    const Place place;
    EXPECT_EQ(refusal(place / ".", resume), "");
  }
}

TEST(FrameFolder, FramesAreContinuedOnlyWithResumeAndTheSameOrigin) {
  const Place place;
  FrameFolder(place / "f", origin, false).write(0, picture(0));
  EXPECT_TRUE(says(refusal(place / "f", false), "already contains frames: continue with --resume"));
  EXPECT_EQ(refusal(place / "f", true), "");
  const std::string other = refusal(place / "f", true, {{"scene", "12"}, {"frames per second", "30"}});
  EXPECT_TRUE(says(other, "drawn with \"frames per second: 24\", which is now \"frames per second: 30\""))
      << other;
  EXPECT_TRUE(says(refusal(place / "f", true, {{"scene", "12"}}), "animation.txt: "));
  EXPECT_TRUE(FrameFolder(place / "f", origin, true).holds(0));
}

TEST(FrameFolder, OnlyWholeFramesAreKept) {
  const Place place;
  {
    FrameFolder folder(place / "f", origin, false);
    for (int frame = 0; frame < 4; ++frame) folder.write(frame, picture(frame));
  }
  const std::string first = place.read("f/frame-00001.png"), record = place.read("f/animation.txt");
  place.write("f/frame-00001.png", first.substr(0, first.size() - 1));
  place.write("f/frame-00002.png", place.read("f/frame-00003.png"));
  fs::remove(place / "f/frame-00003.png");
  FrameFolder folder(place / "f", origin, true);
  EXPECT_TRUE(folder.holds(0));
  for (int frame = 1; frame < 4; ++frame) EXPECT_FALSE(folder.holds(frame)) << frame;
  folder.write(1, picture(1));
  EXPECT_TRUE(folder.holds(1));
  EXPECT_EQ(place.read("f/frame-00001.png"), first);
  EXPECT_EQ(place.read("f/animation.txt"), record);
}

TEST(FrameFolder, WhatAKilledProcessLeavesIsRemoved) {
  const Place place;
  {
    FrameFolder folder(place / "f", origin, false);
    for (int frame = 0; frame < 2; ++frame) folder.write(frame, picture(frame));
  }
  const std::string record = place.read("f/animation.txt");
  place.write("f/animation.txt", record.substr(0, record.size() - 5));
  place.write("f/.frame-00002.4711.png", "half a picture");
  FrameFolder folder(place / "f", origin, true);
  EXPECT_TRUE(folder.holds(0));
  EXPECT_FALSE(folder.holds(1));
  EXPECT_FALSE(fs::exists(place / "f/.frame-00002.4711.png"));
  folder.write(1, picture(1));
  EXPECT_EQ(place.read("f/animation.txt"), record);
}

TEST(FrameFolder, RefusesFoldersThatItCannotContinue) {
  const Place place;
  place.write("file", "text");
  EXPECT_TRUE(says(refusal(place / "file", false), "is not a folder"));
  EXPECT_TRUE(says(refusal(place / "file/f", false), "cannot be created"));
  fs::create_directory(place / "foreign");
  place.write("foreign/frame-00000.png", "picture");
  EXPECT_TRUE(says(refusal(place / "foreign", false), "already contains frames"));
  EXPECT_TRUE(says(refusal(place / "foreign", true), "contains frames, but no animation.txt"));
  place.write("foreign/animation.txt", "");
  EXPECT_TRUE(says(refusal(place / "foreign", true), "animation.txt: is damaged"));
  place.write("foreign/animation.txt",
              "pelage animation 1\nscene: 12\nframes per second: 24\nframes:\nx 12\n");
  EXPECT_TRUE(says(refusal(place / "foreign", true), "\"x 12\" is not the number of a frame and its hash"));
}

TEST(FrameFolder, OneProcessAtATimeDrawsToAFolder) {
  const Place place;
  const FrameFolder first(place / "f", origin, false);
  EXPECT_TRUE(says(refusal(place / "f", true), "another pelage process draws to this folder"));
}

TEST(FrameFolder, KilledAndContinuedItHoldsTheSameFiles) {
  constexpr int frames = 40;
  const Place place;
  const auto draw = [&](const std::string& name) {
    FrameFolder folder(place / name, origin, true);
    for (int frame = 0; frame < frames; ++frame)
      if (!folder.holds(frame)) folder.write(frame, picture(frame));
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
      EXPECT_EQ(place.read(fs::path(name) / file), place.read(fs::path("whole") / file))
          << name << " " << file;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(place / name), fs::directory_iterator()), frames + 1);
  }
  EXPECT_GE(interrupted, 5) << "too few of the kills hit a folder with frames";
}

}  // namespace
}  // namespace pelage
