// Compares pictures of the kernels and of the reference for fragments that take several samples
// (docs/shells.md, section 6, "Sub-steps"). Kernels and reference were written independently of each other;
// both follow that section.
#include <gtest/gtest.h>

#include <vector>

#include "tests/shells/opencl/picture_scenes.hpp"

namespace pelage {
namespace {

using namespace pictures;

std::shared_ptr<const FrameInput> with_substeps(const FrameInput& frame, int substeps) {
  FrameInput input = frame;
  input.scene.fur.substeps = substeps;
  return std::make_shared<FrameInput>(input);
}

struct Case {
  const char* model;
  const char* shading;
  std::vector<const char*> mappings;
};

struct Substeps : testing::TestWithParam<Case> {};

TEST_P(Substeps, LookLikeTheReferenceAndNotLikeOneLook) {
  const auto input = with_substeps(*model_frame(GetParam().model, 16, GetParam().shading), 4);
  const Picture expected = drawn_by_reference(*input);
  const Picture mutant = drawn_by_reference(*with_substeps(*input, 1));
  for (const char* mapping : GetParam().mappings) {
    SCOPED_TRACE(mapping);
    const Picture drawn = drawn_by_device(input, mapping);
    const Agreement same = compare(expected, drawn), other = compare(mutant, drawn);
    EXPECT_TRUE(within(same)) << describe(same);
    EXPECT_GT(same.pixels, 15000u);
    EXPECT_FALSE(within(other)) << describe(other);
    RecordProperty(std::string("agreement_") + mapping, describe(same));
    RecordProperty(std::string("one_look_") + mapping, describe(other));
  }
}

// A mapping is a way to assign pixels to work-items. On PoCL, the mapping `pixel` needs more than 40 s of CPU
// time for the bunny's 142,307 triangles. Therefore only the mapping `tile` draws the bunny here.
INSTANTIATE_TEST_SUITE_P(CurlyWetWindy, Substeps,
                         testing::Values(Case{"torus", "curling", {"tile", "pixel"}},
                                         Case{"torus", "wet", {"tile", "pixel"}},
                                         Case{"bunny", "curling", {"tile"}}, Case{"bunny", "wet", {"tile"}}),
                         [](const auto& given) {
                           return std::string(given.param.model) + "_" + given.param.shading;
                         });

struct SubstepCounts : testing::TestWithParam<int> {};

void expect_same(const FrameInput& input, int substeps) {
  const auto frame = with_substeps(input, substeps);
  const Picture expected = drawn_by_reference(*frame);
  for (const char* mapping : {"tile", "pixel"}) {
    SCOPED_TRACE(mapping);
    const Agreement same = compare(expected, drawn_by_device(frame, mapping));
    EXPECT_TRUE(within(same)) << describe(same);
    EXPECT_GT(same.pixels, 5000u);
    testing::Test::RecordProperty(input.scene.fur.binding + "_" + mapping, describe(same));
  }
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

}  // namespace
}  // namespace pelage
