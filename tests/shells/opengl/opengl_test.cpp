// Tests the options, contexts and errors of the OpenGL baseline. Compares its pictures with those of the
// reference and of the OpenCL pipeline. All three programs were written from docs/shells.md.
#include "harness/shells/opengl/opengl.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "harness/compare/checks.hpp"
#include "harness/compare/frame_output.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/files.hpp"
#include "tests/support/style_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;
using namespace style_scenes;

using test::refusal;

/// The reference's wetness mask, and its strand tips minus roots after `frames` frames.
std::vector<glm::vec4> mask_of(const FrameInput& input) {
  return reference_mask(input, frames);
}
std::vector<glm::vec3> tips_of(const FrameInput& input) {
  return reference_motion(input, frames).tips;
}

/// Draws the frame with the OpenGL baseline. opengl_options() parses the text `options`.
Picture drawn_by_opengl(const std::shared_ptr<const FrameInput>& input, const std::string& options = "") {
  OpenGl opengl(input, mask_of(*input), opengl_options(options));
  opengl.bend(tips_of(*input), frames);
  opengl.frame();
  return opengl.read();
}

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

void expect_agreement(const Picture& expected, const Picture& drawn, std::size_t least_pixels) {
  const Agreement agreement = compare(expected, drawn);
  EXPECT_GE(agreement.psnr, tolerance::other_filter_psnr) << describe(agreement);
  EXPECT_GT(agreement.pixels, least_pixels);  // the pictures must contain enough fur pixels
}

/// With the default options, the picture must meet the limits that also hold for the OpenCL pipeline: a PSNR
/// of at least 60 dB, and a difference of at most 2/255 in 99.9% of the pixels.
void expect_same(const FrameInput& input, std::size_t least_pixels) {
  EXPECT_TRUE(
      same(drawn_by_reference(input), drawn_by_opengl(std::make_shared<FrameInput>(input)), least_pixels));
}

void expect_same(const Cases& cases, std::size_t least_pixels = 5000) {
  for (const auto& [name, input] : cases) {
    SCOPED_TRACE(name);
    expect_same(input, least_pixels);
  }
}

struct Models : testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(Models, LookLikeTheReferenceAndTheOpenClPipeline) {
  const auto& [model, shading] = GetParam();
  const auto input = model_frame(model, 16, shading);
  const Picture drawn = drawn_by_opengl(input);
  EXPECT_TRUE(same(drawn_by_reference(*input), drawn, 15000));
  expect_agreement(drawn_with(input, {}), drawn, 15000);
}

INSTANTIATE_TEST_SUITE_P(CurlyWetWindy, Models,
                         testing::Combine(testing::Values("torus", "bunny"),
                                          testing::Values("curling", "wet")),
                         test::by_parameter);

TEST(OpenGlPicture, BothModelsAndBothBindings) {
  expect_same(models_and_bindings());
}

TEST(OpenGlPicture, OtherReadings) {
  expect_same(other_readings());
}

TEST(OpenGlPicture, ReadingsOfClumpsAndTheirTangents) {
  expect_same(clump_readings());
}

TEST(OpenGlPicture, SoakedFur) {
  expect_same(soaked_fur());
}

TEST(OpenGlPicture, ConsistentBordersOfClumps) {
  expect_same(consistent_borders());
}

TEST(OpenGlPicture, OrdersOfFaces) {
  expect_same(orders_of_faces());
}

TEST(OpenGlPicture, PlainShells) {
  // This scene has no curls and no clumps, so the baseline compiles its shaders without the equations of
  // curls and clumps.
  FrameInput input = *small_frame("curling");
  input.scene.curl.radius = 0;
  input.droplets.clear();
  expect_same(input, 5000);
}

TEST(OpenGlPicture, AnyPictureSize) {
  expect_same(other_sizes(), 0);
}

// The planes at which OpenGL drivers clip triangles differ from the planes that docs/shells.md specifies. The
// corners of a clipped triangle therefore differ between the baseline and the reference, and so do their
// coordinates after the rounding to 1/256 pixel.
TEST(OpenGlPicture, FurThatRunsBehindTheEye) {
  for (const auto& [name, input] : fur_behind_the_eye()) {
    SCOPED_TRACE(name);
    expect_agreement(drawn_by_reference(input), drawn_by_opengl(std::make_shared<FrameInput>(input)), 8000);
  }
}

TEST(OpenGlPicture, AnOpenSurfaceLitOnBothSides) {
  for (const char* shading : {"curling", "wet"}) {
    SCOPED_TRACE(shading);
    expect_same(square_seen_from(-1, shading, "two"), 2000);
  }
}

// A triangle that no pixel shows, and a fragment without coverage, change no bit.
TEST(OpenGlPicture, WhatCannotBeSeenIsLeftOutWithoutATrace) {
  for (const char* faces : face_orders)
    for (const char* cells : {"consistent", "separate"}) {
      FrameInput input = *small_frame("wet");
      input.scene.blend.faces = faces;
      input.scene.clump.cells = cells;
      const auto given = std::make_shared<FrameInput>(input);
      const Picture drawn = drawn_by_opengl(given);
      for (const char* options : {"draws=each,triangles=seen", "discard=no"})
        EXPECT_TRUE(same_bits(drawn, drawn_by_opengl(given, options)))
            << faces << ", " << cells << ", " << options;
    }
}

struct Writings : testing::TestWithParam<const char*> {};

TEST_P(Writings, GiveTheSamePicture) {
  const auto input = small_frame("curling");
  expect_agreement(drawn_by_reference(*input), drawn_by_opengl(input, GetParam()), 5000);
}

INSTANTIATE_TEST_SUITE_P(Options, Writings,
                         testing::Values("draws=each", "texels=byte", "target=rgba16f",
                                         "draws=each,triangles=seen", "discard=no"),
                         test::by_parameter);

TEST(OpenGlPicture, EightBitsAreThoseOfTheEightBitReference) {
  // With target=rgba8 the baseline rounds to 8 bits after every layer. Its picture must be closer to the
  // reference with 8-bit rounding than to the reference without rounding.
  const auto input = small_frame("curling");
  const Picture drawn = drawn_by_opengl(input, "target=rgba8");
  const double rounded = compare(drawn_by_reference(*input, reference::Mutant::none, true), drawn).psnr;
  const double floats = compare(drawn_by_reference(*input), drawn).psnr;
  EXPECT_GT(rounded, floats + 3.0) << floats;
  EXPECT_GT(rounded, 45.0);
}

TEST(OpenGlPicture, MistakesAreSeen) {
  // With blend.faces "back-then-front", the order of the triangles has little effect.
  FrameInput all = *small_frame("curling");
  all.scene.blend.faces = "all";
  const auto input = std::make_shared<FrameInput>(all);
  const Picture drawn = drawn_by_opengl(input);
  for (const reference::Mutant mutant : planted) {
    const Agreement agreement = compare(drawn_by_reference(*input, mutant), drawn);
    EXPECT_LT(agreement.psnr, tolerance::other_filter_psnr)
        << "mutant " << int(mutant) << ": " << describe(agreement);
  }
}

// Compares the OpenGL baseline's pictures of fur with maps (docs/shells.md, section 8) and with colliders
// (docs/colliders.md) with the reference. Also tests water that changes over time (section 10).

TEST(OpenGlStyle, LooksLikeTheReference) {
  const auto input = with_all_maps([](Scene&) {});
  EXPECT_TRUE(same(drawn_by_reference(*input), drawn_by_opengl(input)));
}

TEST(OpenGlStyle, MapsOfOneHalfAreHalfTheKeysBitForBit) {
  const test::Folder folder;
  const auto half = write_map(folder.path / "half.exr", 2, 3, [](glm::vec2) { return 0.5f; });
  const Picture mapped = drawn_by_opengl(small_torus([&](Scene& s) { set_maps(s, half); }));
  const Picture halved = drawn_by_opengl(small_torus([](Scene& s) {
    for (const MapKey& key : map_keys(s)) key.value *= 0.5f;
  }));
  EXPECT_TRUE(same_bits(mapped, halved));
}

TEST(OpenGlContact, LooksLikeTheReference) {
  for (const auto& input : {pressed_fur(), kneaded_fur()})
    EXPECT_TRUE(same(drawn_by_reference(*input), drawn_by_opengl(input)));
}

TEST(OpenGlWater, ANewMaskGivesThePictureOfAFreshScene) {
  FrameInput input = *small_frame("wet");
  input.scene.wetness.soak = .3f;
  ASSERT_GT(input.droplets.size(), 0u);
  const auto shared = std::make_shared<FrameInput>(input);
  const std::vector<glm::vec4> mask = mask_of(input), none(mask.size());
  OpenGl changed(shared, none);
  changed.bend(tips_of(input));
  changed.frame();
  const Picture dry = changed.read();
  changed.set_mask(mask);
  changed.frame();
  const Picture wet = changed.read(), fresh = drawn_by_opengl(shared);
  EXPECT_FALSE(same_bits(wet, dry));
  EXPECT_TRUE(same_bits(wet, fresh));
  for (const Check& check : other_filter_checks(against_reference, compare(wet, drawn_by_reference(input))))
    EXPECT_TRUE(check.holds()) << check.metric << " " << check.value;
  EXPECT_THROW(changed.set_mask({}), std::exception);
}

TEST(OpenGlWater, OfAStillSceneKeepsItsMask) {
  const auto still = small_frame("wet");
  OpenGl opengl(still, mask_of(*still));
  EXPECT_THROW(opengl.set_mask(mask_of(*still)), std::logic_error);
}

TEST(OpenGlShadow, IsTheDarkening) {
  const auto input = std::make_shared<FrameInput>(*small_frame("curling"));
  for (const char* shadow : {"off", "traced"}) {
    input->scene.shading.self_shadow = shadow;
    const std::string said = refusal([&] { OpenGl(input, mask_of(*input)); });
    EXPECT_NE(said.find("shading.self_shadow"), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace pelage
