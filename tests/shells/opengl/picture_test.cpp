// Compares the pictures of the OpenGL baseline with those of the reference and the OpenCL pipeline. All three
// programs were written from docs/shells.md.
#include <gtest/gtest.h>

#include <stdexcept>

#include "harness/compare/checks.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/mesh/mesh.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/shells/opengl/scenes.hpp"
#include "tests/support/files.hpp"
#include "tests/support/style_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace rival_tests;

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

struct Case {
  const char* model;
  const char* shading;
};

struct Models : testing::TestWithParam<Case> {};

TEST_P(Models, LookLikeTheReferenceAndTheOpenClPipeline) {
  const auto input = model_frame(GetParam().model, 16, GetParam().shading);
  const Picture drawn = drawn_by_opengl(input);
  EXPECT_TRUE(same(drawn_by_reference(*input), drawn, 15000));
  expect_agreement(drawn_with(input, {}), drawn, 15000);
}

INSTANTIATE_TEST_SUITE_P(CurlyWetWindy, Models,
                         testing::Values(Case{"torus", "curling"}, Case{"torus", "wet"},
                                         Case{"bunny", "curling"}, Case{"bunny", "wet"}),
                         [](const auto& given) {
                           return std::string(given.param.model) + "_" + given.param.shading;
                         });

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
                         [](const auto& given) {
                           std::string name = given.param;
                           for (char& c : name)
                             if (c == '=' || c == ',') c = '_';
                           return name;
                         });

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
  using reference::Mutant;
  // With blend.faces "back-then-front", the order of the triangles has little effect.
  FrameInput all = *small_frame("curling");
  all.scene.blend.faces = "all";
  const auto input = std::make_shared<FrameInput>(all);
  const Picture drawn = drawn_by_opengl(input);
  for (const Mutant mutant : {Mutant::layer_missing, Mutant::height_without_one, Mutant::triangles_reversed,
                              Mutant::front_faces_culled, Mutant::uv_swapped, Mutant::mask_bilinear,
                              Mutant::droplets_reversed, Mutant::log_negated}) {
    const Agreement agreement = compare(drawn_by_reference(*input, mutant), drawn);
    EXPECT_LT(agreement.psnr, tolerance::other_filter_psnr)
        << "mutant " << int(mutant) << ": " << describe(agreement);
  }
}

// Compares the OpenGL baseline's pictures of fur with maps (docs/shells.md, section 8) and with colliders
// (docs/shells.md, section 9) with the reference. Also tests water that changes over time (section 10).

using namespace style_scenes;

void set_maps(Scene& s, const std::filesystem::path& map) {
  s.fur.length_map = s.fur.density_map = s.fur.comb_map = s.curl.radius_map = s.curl.turns_map = map;
}

TEST(OpenGlStyle, LooksLikeTheReference) {
  const test::Folder folder;
  const auto map = write_map(folder.path / "wavy.exr", 32, 16, wavy);
  const auto input = small_torus([&](Scene& s) { set_maps(s, map); });
  EXPECT_TRUE(same(drawn_by_reference(*input), drawn_by_opengl(input)));
}

TEST(OpenGlStyle, MapsOfOneHalfAreHalfTheKeysBitForBit) {
  const test::Folder folder;
  const auto half = write_map(folder.path / "half.exr", 2, 3, [](glm::vec2) { return 0.5f; });
  const Picture mapped = drawn_by_opengl(small_torus([&](Scene& s) { set_maps(s, half); }));
  const Picture halved = drawn_by_opengl(small_torus([](Scene& s) {
    for (float* key : {&s.fur.length, &s.fur.density, &s.fur.comb, &s.curl.radius, &s.curl.turns})
      *key *= 0.5f;
  }));
  EXPECT_TRUE(same_bits(mapped, halved));
}

TEST(OpenGlContact, LooksLikeTheReference) {
  const test::Folder folder;
  const auto torus = folder.path / "torus.ply";
  write_ply(torus, *load_model("torus-24x16"));
  const auto input = long_fur([&](Scene& s) { press(s, torus); });
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

}  // namespace
}  // namespace pelage
