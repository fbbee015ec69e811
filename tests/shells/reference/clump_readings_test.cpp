// Tests the readings of S Eq. 5 and W Eq. 4 on a flat patch with one droplet: strands that the clump leans
// are traced from their roots through the layers.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/shading.hpp"

namespace pelage::reference {
namespace {

constexpr int layers = 16;
constexpr double radius = .2, wetness = .9;
const glm::dvec2 centre(.5, .5);

/// A mask that one clump covers.
const Mask one_clump{1, {{centre, radius, wetness}}};

FrameInput input_with(const char* scale, float shape) {
  FrameInput input;
  input.scene.fur.layers = layers;
  input.scene.clump.scale = scale;
  input.scene.clump.shape = shape;
  input.scene.clump.gain = 3.5 / radius;
  input.scene.clump.cells = "literal";
  return input;
}

double height(int n) {
  return (1. + n) / layers;
}

/// Returns the distance from the centre at which layer n shows the strand whose root is `root` away from the
/// centre, by bisection over the displacements. The result is below 0 if no point of the layer shows it.
double traced(const FrameInput& input, double root, int n) {
  if (n < 0) return root;
  const auto shown = [&](double at) {
    return at + clump_displacement(input, one_clump, centre + glm::dvec2(at, 0), n).d.x;
  };
  double low = 1e-12, high = radius;
  if (shown(low) > root) return -1;
  for (int i = 0; i < 100; ++i) {
    const double middle = .5 * (low + high);
    (shown(middle) < root ? low : high) = middle;
  }
  return .5 * (low + high);
}

/// Returns the greatest distance of a traced strand from the straight line between its root and its tip, as a
/// part of its lean.
double crooked(const FrameInput& input, double root) {
  const double lean = traced(input, root, layers - 1) - root;
  double most = 0;
  for (int n = 0; n < layers; ++n)
    most = std::max(most, std::abs(traced(input, root, n) - root - height(n) * lean) / std::abs(lean));
  return most;
}

TEST(ClumpReadings, StrandsAreStraightIfTheShapeIsZero) {
  for (const char* scale : {"distance", "converge"})
    for (const double root :
         {.185, .19, .199})  // further from the centre than rho r, so that "distance" draws them
      EXPECT_LT(crooked(input_with(scale, 0), root), 1e-6) << scale << ", root at " << root;
  // Both papers say that w = 0 gives straight strands. With the printed factor they are curved.
  EXPECT_GT(crooked(input_with("literal", 0), .19), .25);
}

TEST(ClumpReadings, TheOutlineIsTheRadiusTimesOneMinusRhoF) {
  for (const char* scale : {"distance", "converge"})
    for (const float shape : {0.f, .4f, 1.f}) {
      const FrameInput input = input_with(scale, shape);
      for (int n = 0; n < layers; ++n)
        EXPECT_NEAR(traced(input, radius, n),
                    radius * (1 - wetness * clump_shape(height(n), double(shape), layers)), 1e-9)
            << scale << ", layer " << n;
    }
}

TEST(ClumpReadings, TheTangentIsThatOfTheTracedStrand) {
  // The patch is X = (u, v, 0), and upright strands have the length .3.
  const glm::dvec3 t(1, 0, 0), b(0, 1, 0), normal(0, 0, 1);
  for (const char* scale : clump_scales)
    for (const float shape : {0.f, .7f}) {
      FrameInput input = input_with(scale, shape);
      input.scene.shading.tangent = "strand";
      for (const double root : {.08, .15, .19})
        for (int n = 0; n < layers; ++n) {
          const double at = traced(input, root, n), below = traced(input, root, n - 1);
          if (!(at > 0 && below > 0)) continue;
          const glm::dvec3 rise(0, 0, .3 / layers);
          const Displacement clump = clump_displacement(input, one_clump, centre + glm::dvec2(at, 0), n);
          const glm::dvec3 found = wet_tangent(input.scene, rise, t, b, normal, clump);
          const glm::dvec3 expected = glm::normalize(glm::dvec3(at - below, 0, 0) + rise);
          EXPECT_GT(glm::dot(found, expected), 1 - 1e-9) << scale << ", root " << root << ", layer " << n;
        }
    }
}

TEST(ClumpReadings, StretchIsTheDerivativeOfTheRoot) {
  const FrameInput input = input_with("converge", .3f);
  for (int n = 0; n < layers; ++n) {
    const auto root = [&](double at) {
      return at + clump_displacement(input, one_clump, centre + glm::dvec2(at, 0), n).d.x;
    };
    const Displacement clump = clump_displacement(input, one_clump, centre + glm::dvec2(.1, 0), n);
    EXPECT_NEAR((root(.1 + 1e-5) - root(.1 - 1e-5)) / 2e-5, clump.stretch, 1e-6 * clump.stretch);
  }
}

TEST(ClumpReadings, ADropletOfNoWetnessMovesNothing) {
  for (const char* scale : clump_scales) {
    const Mask mask{1, {{centre, radius, 0x1p-40}}};
    const Displacement clump =
        clump_displacement(input_with(scale, 0), mask, centre + glm::dvec2(.1, .05), layers - 1);
    EXPECT_LT(glm::length(clump.d), 1e-11) << scale;
    EXPECT_FALSE(clump.discarded);
  }
}

}  // namespace
}  // namespace pelage::reference
