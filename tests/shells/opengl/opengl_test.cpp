// Tests the options, contexts and errors of the OpenGL baseline. picture_test.cpp tests its pictures.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "harness/error.hpp"
#include "tests/shells/opengl/scenes.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace rival_tests;

using test::refusal;

TEST(OpenGlOptions, AreReadAndWritten) {
  EXPECT_EQ(opengl_options(""), OpenGlOptions{});
  const OpenGlOptions options = opengl_options("draws=each,target=rgba8");
  EXPECT_EQ(options.draws, "each");
  EXPECT_EQ(options.target, "rgba8");
  EXPECT_EQ(options.fur, OpenGlOptions{}.fur);
  EXPECT_EQ(opengl_options(to_text(options)), options);
}

TEST(OpenGlOptions, BadOnesAreRefused) {
  for (const char* text : {"draw=each", "draws", "draws=", "draws=all", "draws=each,,target=rgba8",
                           "fur=slices", "vertices=corners", "target=rgba8 "}) {
    const std::string said = refusal([&] { opengl_options(text); });
    EXPECT_NE(said.find("OpenGL option"), std::string::npos) << text << ": " << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
}

TEST(OpenGl, WithoutAnEglDriverSaysSo) {
  // The test runs in a process of its own, because EGL looks for its drivers only once per process.
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto ask = [] {
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent/none.json", 1);
    const std::string said = refusal([] { opengl_renderer(); }, "");
    std::fprintf(stderr, "%s\n", said.c_str());
    std::exit(said.empty() ? 0 : 2);
  };
  EXPECT_EXIT(ask(), testing::ExitedWithCode(2), "no OpenGL: EGL finds no driver; install libegl1");
}

TEST(OpenGl, NamesTheRenderer) {
  EXPECT_NE(opengl_renderer().find("OpenGL 4"), std::string::npos) << opengl_renderer();
}

TEST(OpenGl, ScenesDoNotDisturbEachOther) {
  const auto curling = small_frame("curling"), wet = small_frame("wet");
  const Picture alone = drawn_by_opengl(curling);
  OpenGl a(curling, mask_of(*curling)), b(wet, mask_of(*wet));
  a.bend(tips_of(*curling));
  a.frame();
  b.frame();
  EXPECT_EQ(a.read().pixel, alone.pixel);
  OpenGl moved = std::move(a);
  EXPECT_GT(moved.frame(), 0.0);
  EXPECT_EQ(moved.read().pixel, alone.pixel);
  { const OpenGl gone = std::move(b); }
  moved.frame();
  EXPECT_EQ(moved.read().pixel, alone.pixel);
}

TEST(OpenGl, StandsAtRestUntilBent) {
  const auto input = small_frame("curling");
  OpenGl opengl(input, mask_of(*input));
  opengl.frame();
  const Picture rest = opengl.read();
  opengl.bend(tips_of(*input));
  opengl.frame();
  EXPECT_LT(compare(rest, opengl.read()).psnr, 40.0);  // the bent fur must look different
  opengl.bend(input->strands.anchor);
  opengl.frame();
  EXPECT_EQ(opengl.read().pixel, rest.pixel);
}

TEST(OpenGl, RefusesWhatDoesNotFit) {
  const auto input = small_frame("curling");
  EXPECT_NE(refusal([&] { OpenGl(input, {}); }).find("wetness mask"), std::string::npos);
  OpenGl opengl(input, mask_of(*input));
  EXPECT_NE(refusal([&] { opengl.bend({}); }).find("tips"), std::string::npos);
}

TEST(OpenGl, ReportsWhatTheDriverRefuses) {
  FrameInput input = *small_frame("curling");
  input.camera.width = 1 << 20;  // wider than any renderbuffer
  const auto wide = std::make_shared<FrameInput>(input);
  const std::string said = refusal<DeviceError>([&] { OpenGl(wide, mask_of(*wide)); });
  EXPECT_NE(said.find("GL_INVALID_VALUE"), std::string::npos) << said;
}

/// Copies the shaders to a temporary folder. PELAGE_DATA names this folder while the object exists.
struct OwnShaders : test::Folder {
  OwnShaders() {
    std::filesystem::copy(std::filesystem::path(PELAGE_SOURCE_DIR) / "shaders", path / "shaders");
    setenv("PELAGE_DATA", path.c_str(), 1);
  }
  ~OwnShaders() { unsetenv("PELAGE_DATA"); }
};

TEST(OpenGl, TakesShadersOfOnesOwn) {
  const auto input = small_frame("curling");
  const std::string shipped = shader_hash();
  const OwnShaders own;
  EXPECT_EQ(shader_hash(), shipped);
  std::ofstream(own.path / "shaders/fur.frag", std::ios::app) << "\nvec4 oops() { return no_such_name; }\n";
  EXPECT_NE(shader_hash(), shipped);
  const std::string said = refusal<DeviceError>([&] { OpenGl(input, mask_of(*input)); });
  EXPECT_NE(said.find("does not compile fur.frag"), std::string::npos) << said;
  EXPECT_NE(said.find("no_such_name"), std::string::npos) << said;
  std::filesystem::remove(own.path / "shaders/fur.frag");
  EXPECT_NE(refusal([&] { OpenGl(input, mask_of(*input)); }).find("fur.frag"), std::string::npos);
}

}  // namespace
}  // namespace pelage
