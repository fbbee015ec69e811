// Compares the device's pictures with those of the reference. Kernels and reference were written
// independently of each other; both follow the two papers of Silva et al. 2010
// (docs/shells.md).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

void expect_agreement(const Picture& expected, const Picture& drawn, std::size_t least_pixels) {
  const Agreement agreement = compare(expected, drawn);
  EXPECT_TRUE(within(agreement)) << describe(agreement);
  EXPECT_GT(agreement.pixels, least_pixels);  // the pictures must contain enough fur pixels
  ::testing::Test::RecordProperty("agreement", describe(agreement));
}

struct ModelCase {
  const char* model;
  int layers;
  const char* shading;
};

struct Models : testing::TestWithParam<ModelCase> {};

TEST_P(Models, LookLikeTheReference) {
  const auto input = model_frame(GetParam().model, GetParam().layers, GetParam().shading);
  expect_agreement(drawn_by_reference(*input), drawn_by_device(input, "tile"), 15000);
}

INSTANTIATE_TEST_SUITE_P(CurlyWetWindy, Models,
                         testing::Values(ModelCase{"torus", 16, "curling"}, ModelCase{"torus", 64, "curling"},
                                         ModelCase{"torus", 16, "wet"}, ModelCase{"torus", 64, "wet"},
                                         ModelCase{"bunny", 16, "curling"}, ModelCase{"bunny", 64, "curling"},
                                         ModelCase{"bunny", 16, "wet"}, ModelCase{"bunny", 64, "wet"},
                                         ModelCase{"torus", 16, "lambert"}),
                         [](const auto& given) {
                           return std::string(given.param.model) + "_" + std::to_string(given.param.layers) +
                                  "_" + given.param.shading;
                         });

/// Returns a frame of a torus, seen by an eye inside its fur.
std::shared_ptr<const FrameInput> with_the_eye_inside(const char* faces) {
  Scene scene = synthetic::lively_scene();
  scene.blend.faces = faces;
  scene.fur.layers = 8;
  scene.camera.eye = {1.05f, .04f, 0};
  scene.camera.target = {1, 0, 1};
  scene.camera.fov = 80;
  return std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::torus(), 12, 8, 30));
}

struct Mappings : testing::TestWithParam<const char*> {};

TEST_P(Mappings, BothModelsAndBothBindings) {
  for (const char* shading : {"curling", "wet"})
    for (const char* binding : {"shared", "separate"}) {
      SCOPED_TRACE(std::string(shading) + ", " + binding);
      const auto input = small_frame(shading, binding);
      expect_agreement(drawn_by_reference(*input), drawn_by_device(input, GetParam()), 5000);
    }
}

TEST_P(Mappings, OtherReadings) {
  // Where the papers are ambiguous, scene keys select an interpretation. The test sets these keys to values
  // other than the defaults.
  FrameInput input = *small_frame("wet");
  input.scene.fur.layer_spacing = "uniform";
  input.scene.fur.layer_correction = "fragment";
  input.scene.clump.scale = "literal";
  input.scene.clump.cells = "literal";
  input.scene.wetness.blend = "near";
  input.scene.blend.faces = "all";
  input.scene.shading.tangent = "drawn";
  input.scene.shading.wrap = 0;
  const auto wet = std::make_shared<FrameInput>(input);
  expect_agreement(drawn_by_reference(*wet), drawn_by_device(wet, GetParam()), 5000);
  input.scene.shading.model = "curling";
  input.scene.shading.lights.resize(1);
  input.scene.clump.scale = "relative";
  input.scene.clump.cells = "separate";
  const auto curling = std::make_shared<FrameInput>(input);
  expect_agreement(drawn_by_reference(*curling), drawn_by_device(curling, GetParam()), 5000);
}

TEST_P(Mappings, ReadingsOfClumpsAndTheirTangents) {
  FrameInput input = *small_frame("wet");
  for (const auto& [scale, tangent] : {std::pair{"relative", "strand"},
                                       {"distance", "strand"},
                                       {"converge", "strand"},
                                       {"converge", "paper"},
                                       {"distance", "printed"}}) {
    SCOPED_TRACE(std::string(scale) + ", " + tangent);
    input.scene.clump.scale = scale;
    input.scene.shading.tangent = tangent;
    const auto given = std::make_shared<FrameInput>(input);
    expect_agreement(drawn_by_reference(*given), drawn_by_device(given, GetParam()), 5000);
  }
  input.scene.fur.substeps = 4;
  const auto many = std::make_shared<FrameInput>(input);
  expect_agreement(drawn_by_reference(*many), drawn_by_device(many, GetParam()), 5000);
}

TEST_P(Mappings, SoakedFur) {
  FrameInput input = *small_frame("wet");
  input.scene.clump.cells = "consistent";
  input.scene.wetness.blend = "overlap";
  input.scene.soaked.threshold = 0.6f;
  for (const char* scale : {"converge", "distance"})
    for (const int substeps : {1, 4}) {
      SCOPED_TRACE(fmt::format("{} {}", scale, substeps));
      input.scene.clump.scale = scale;
      input.scene.fur.substeps = substeps;
      const auto given = std::make_shared<FrameInput>(input);
      expect_agreement(drawn_by_reference(*given), drawn_by_device(given, GetParam()), 5000);
    }
}

TEST_P(Mappings, ConsistentBordersOfClumps) {
  FrameInput input = *small_frame("wet");
  input.scene.clump.cells = "consistent";
  input.scene.wetness.blend = "overlap";
  for (const char* scale : clump_scales) {
    SCOPED_TRACE(scale);
    input.scene.clump.scale = scale;
    const auto given = std::make_shared<FrameInput>(input);
    expect_agreement(drawn_by_reference(*given), drawn_by_device(given, GetParam()), 5000);
  }
}

TEST_P(Mappings, OrdersOfFaces) {
  for (const char* faces : {"front", "back-then-front"})
    for (const char* binding : {"shared", "separate"}) {
      SCOPED_TRACE(std::string(faces) + ", " + binding);
      FrameInput input = *small_frame("wet", binding);
      input.scene.blend.faces = faces;
      const auto given = std::make_shared<FrameInput>(input);
      expect_agreement(drawn_by_reference(*given), drawn_by_device(given, GetParam()), 5000);
    }
  // The camera is so near that triangles of the base are clipped.
  const auto input = with_the_eye_inside("back-then-front");
  expect_agreement(drawn_by_reference(*input), drawn_by_device(input, GetParam()), 8000);
}

TEST_P(Mappings, FurThatRunsBehindTheEye) {
  // The camera is so near to a square that the square's triangles cross the near plane and the guard band.
  Scene scene = synthetic::lively_scene();
  scene.fur.length = .05f;
  scene.camera.eye = {.13f, -.21f, .25f};
  scene.camera.target = {.3f, 1.2f, 0};
  scene.camera.up = {0, 0, 1};
  scene.camera.fov = 70;
  for (const int cells : {1, 7}) {
    const auto input =
        std::make_shared<FrameInput>(synthetic::frame(scene, synthetic::square(6), cells, cells, 30));
    SCOPED_TRACE(cells);
    expect_agreement(drawn_by_reference(*input), drawn_by_device(input, GetParam()), 8000);
  }
}

TEST_P(Mappings, TheEyeInsideTheFur) {
  // Near the eye, some triangles of a layer cross the near plane and are clipped. Unclipped triangles are
  // drawn before and after the clipped triangles.
  const auto input = with_the_eye_inside("all");
  expect_agreement(drawn_by_reference(*input), drawn_by_device(input, GetParam()), 8000);
}

TEST_P(Mappings, AnyPictureSize) {
  for (const auto& [width, height] : {std::pair{1, 1}, {17, 33}, {161, 99}}) {
    FrameInput input = *small_frame("curling");
    input.camera = synthetic::camera(input.scene.camera, width, height);
    input.scene.image.width = width;
    input.scene.image.height = height;
    const auto sized = std::make_shared<FrameInput>(input);
    SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
    const Picture expected = drawn_by_reference(*sized), drawn = drawn_by_device(sized, GetParam());
    const Agreement agreement = compare(expected, drawn);
    EXPECT_EQ(drawn.pixel.size(), std::size_t(width) * std::size_t(height));
    // A picture of one pixel has too few pixels for a percentile. In a large picture, a pixel on the border
    // of two clumps may flip.
    if (agreement.pixels < 1000)
      EXPECT_LE(agreement.worst, tolerance::few_pixels_difference) << describe(agreement);
    else
      EXPECT_TRUE(within(agreement)) << describe(agreement);
  }
}

INSTANTIATE_TEST_SUITE_P(Device, Mappings, testing::Values("tile", "pixel", "group"),
                         [](const auto& given) { return std::string(given.param); });

}  // namespace
}  // namespace pelage
