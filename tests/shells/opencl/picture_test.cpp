// Compares the device's pictures with those of the reference. Kernels and reference were written
// independently of each other; both follow S and W (docs/shells.md).
#include <gtest/gtest.h>

#include "harness/compare/tolerances.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace pictures;

using ModelCase = std::tuple<const char*, int, const char*>;
struct Models : testing::TestWithParam<ModelCase> {};

TEST_P(Models, LookLikeTheReference) {
  const auto& [model, layers, shading] = GetParam();
  EXPECT_TRUE(drawn_alike(model_frame(model, layers, shading), "tile", 15000));
}

INSTANTIATE_TEST_SUITE_P(CurlyWetWindy, Models,
                         testing::Values(ModelCase{"torus", 16, "curling"}, ModelCase{"torus", 64, "curling"},
                                         ModelCase{"torus", 16, "wet"}, ModelCase{"torus", 64, "wet"},
                                         ModelCase{"bunny", 16, "curling"}, ModelCase{"bunny", 64, "curling"},
                                         ModelCase{"bunny", 16, "wet"}, ModelCase{"bunny", 64, "wet"},
                                         ModelCase{"torus", 16, "lambert"}),
                         test::by_parameter);

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

struct Mappings : testing::TestWithParam<std::string> {};

void expect_alike(const Cases& cases, const std::string& mapping, std::size_t least_pixels = 5000) {
  for (const auto& [name, input] : cases)
    EXPECT_TRUE(drawn_alike(std::make_shared<FrameInput>(input), mapping, least_pixels)) << name;
}

TEST_P(Mappings, BothModelsAndBothBindings) {
  expect_alike(models_and_bindings(), GetParam());
}

TEST_P(Mappings, OtherReadings) {
  expect_alike(other_readings(), GetParam());
}

TEST_P(Mappings, ReadingsOfClumpsAndTheirTangents) {
  Cases cases = clump_readings();
  cases.emplace_back("4 sub-steps", cases.back().second).second.scene.fur.substeps = 4;
  expect_alike(cases, GetParam());
}

TEST_P(Mappings, SoakedFur) {
  for (const int substeps : {1, 4}) {
    SCOPED_TRACE(substeps);
    Cases cases = soaked_fur();
    for (auto& [name, input] : cases) input.scene.fur.substeps = substeps;
    expect_alike(cases, GetParam());
  }
}

TEST_P(Mappings, ConsistentBordersOfClumps) {
  expect_alike(consistent_borders(), GetParam());
}

TEST_P(Mappings, OrdersOfFaces) {
  expect_alike(orders_of_faces(), GetParam());
  // The camera is so near that triangles of the base are clipped.
  EXPECT_TRUE(drawn_alike(with_the_eye_inside("back-then-front"), GetParam(), 8000));
}

TEST_P(Mappings, FurThatRunsBehindTheEye) {
  expect_alike(fur_behind_the_eye(), GetParam(), 8000);
}

TEST_P(Mappings, TheEyeInsideTheFur) {
  // Near the eye, some triangles of a layer cross the near plane and are clipped. Unclipped triangles are
  // drawn before and after the clipped triangles.
  EXPECT_TRUE(drawn_alike(with_the_eye_inside("all"), GetParam(), 8000));
}

TEST_P(Mappings, AnyPictureSize) {
  for (const auto& [name, input] : other_sizes()) {
    SCOPED_TRACE(name);
    const Picture expected = drawn_by_reference(input),
                  drawn = drawn_by_device(std::make_shared<FrameInput>(input), GetParam());
    const Agreement agreement = compare(expected, drawn);
    EXPECT_EQ(drawn.pixel.size(),
              std::size_t(input.scene.image.width) * std::size_t(input.scene.image.height));
    // A picture of one pixel has too few pixels for a percentile. In a large picture, a pixel on the border
    // of two clumps may flip.
    if (agreement.pixels < 1000)
      EXPECT_LE(agreement.worst, tolerance::few_pixels_difference) << describe(agreement);
    else
      EXPECT_TRUE(within(agreement)) << describe(agreement);
  }
}

INSTANTIATE_TEST_SUITE_P(Device, Mappings, testing::ValuesIn(mappings()), test::by_parameter);

// The kernels' code for processors without AVX-512 and for compilers without Clang's builtins. Build options
// (kernels/dialect.clh) select this code, so the test also works on a machine with AVX-512 and Clang.
struct Forms : testing::TestWithParam<const char*> {};

TEST_P(Forms, LookLikeTheReference) {
  if (device().info().lanes != 16) GTEST_SKIP() << "the kernels have these forms at 16 lanes only";
  for (const char* shading : {"curling", "wet"}) {
    const auto input = small_frame(shading);
    // This tuning entry becomes a build option of the kernels, which selects the code to test.
    const Picture drawn = drawn_with(input, {"tile", {{GetParam(), 1}}});
    EXPECT_TRUE(same(drawn_by_reference(*input), drawn, 5000)) << shading;
  }
}

INSTANTIATE_TEST_SUITE_P(SixteenLanes, Forms, testing::Values("NO_AVX512", "NO_BUILTINS"),
                         test::by_parameter);

// Fragments that take several samples (docs/shells.md, section 6, "Sub-steps").
std::shared_ptr<const FrameInput> with_substeps(const FrameInput& frame, int substeps) {
  FrameInput input = frame;
  input.scene.fur.substeps = substeps;
  return std::make_shared<FrameInput>(input);
}

struct Substeps : testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(Substeps, LookLikeTheReferenceAndNotLikeOneLook) {
  const auto& [model, shading] = GetParam();
  const auto input = with_substeps(*model_frame(model, 16, shading), 4);
  const Picture expected = drawn_by_reference(*input);
  const Picture mutant = drawn_by_reference(*with_substeps(*input, 1));
  for (const char* mapping : {"tile", "pixel"}) {
    // On PoCL, the mapping `pixel` needs more than 40 s of CPU time for the bunny's 142,307 triangles.
    if (mapping == std::string("pixel") && model == std::string("bunny")) continue;
    SCOPED_TRACE(mapping);
    const Picture drawn = drawn_by_device(input, mapping);
    const Agreement other = compare(mutant, drawn);
    EXPECT_TRUE(same(expected, drawn, 15000));
    EXPECT_FALSE(within(other)) << describe(other);
  }
}

INSTANTIATE_TEST_SUITE_P(CurlyWetWindy, Substeps,
                         testing::Combine(testing::Values("torus", "bunny"),
                                          testing::Values("curling", "wet")),
                         test::by_parameter);

struct SubstepCounts : testing::TestWithParam<int> {};

void expect_same(const FrameInput& input, int substeps) {
  const auto frame = with_substeps(input, substeps);
  const Picture expected = drawn_by_reference(*frame);
  for (const char* mapping : {"tile", "pixel"})
    EXPECT_TRUE(same(expected, drawn_by_device(frame, mapping), 5000)) << mapping;
}

TEST_P(SubstepCounts, CombedFurToo) {
  expect_same(*small_frame("curling"), GetParam());
}

TEST_P(SubstepCounts, OtherReadingsToo) {
  FrameInput input = *small_frame("wet", "separate");
  input.scene.fur.layer_spacing = "uniform";
  input.scene.fur.layer_correction = "fragment";
  input.scene.clump.scale = "literal";
  input.scene.clump.cells = "literal";
  expect_same(input, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Device, SubstepCounts, testing::Values(2, 8));

// Tests shading.sides = "two": an open surface that is seen from behind is lit as if its normals faced the
// eye.

/// Returns the mean red value of the pixels that show the surface.
double brightness(const Picture& picture) {
  double sum = 0;
  std::size_t pixels = 0;
  for (const auto& p : picture.pixel)
    if (p.a > .5f) {
      sum += double(p.r);
      ++pixels;
    }
  return pixels == 0 ? 0 : sum / double(pixels);
}

struct TwoSided : testing::TestWithParam<std::tuple<std::string, const char*>> {};

TEST_P(TwoSided, IsTheReferencesPicture) {
  const auto& [mapping, shading] = GetParam();
  for (const float side : {1.0f, -1.0f}) {
    const auto input = std::make_shared<FrameInput>(square_seen_from(side, shading, "two"));
    EXPECT_TRUE(drawn_alike(input, mapping, 2000)) << side;
  }
}

TEST_P(TwoSided, LightsTheBackAndLeavesTheFront) {
  const std::string mapping = std::get<0>(GetParam());
  const char* shading = std::get<1>(GetParam());
  const auto drawn = [&](float side, const char* sides) {
    return drawn_by_device(std::make_shared<FrameInput>(square_seen_from(side, shading, sides)), mapping);
  };
  const Picture front = drawn(1, "one"), front_two = drawn(1, "two");
  EXPECT_EQ(compare(front, front_two).worst, 0.0);
  // Fur does not shadow the back of the surface, which shows skin. The back must be at least half as bright
  // as the fur on the front.
  const double back = brightness(drawn(-1, "two"));
  EXPECT_GT(back, 5 * brightness(drawn(-1, "one")));
  EXPECT_GT(back, 0.5 * brightness(front));
}

INSTANTIATE_TEST_SUITE_P(Of, TwoSided,
                         testing::Combine(testing::ValuesIn(mappings()),
                                          testing::Values("curling", "wet", "lambert")),
                         test::by_parameter);

}  // namespace
}  // namespace pelage
