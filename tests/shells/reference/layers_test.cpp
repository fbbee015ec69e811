// Tests Eq. 1 and 4 of paper S and the strand's curve (docs/shells.md, section 3). Paper S is Silva et al.
// 2010, Curling and Clumping Fur.
#include "harness/shells/reference/layers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/shells/reference/reference.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using namespace reference;

const glm::dvec3 a(.02, -.03, .09), b(.05, .06, .04), u(1, 0, 0), v(0, 1, 0);

double distance(const glm::dvec3& p, const glm::dvec3& q) {
  return glm::length(p - q);
}

TEST(ReferenceLayers, HeightsRunFromOneNthToOne) {
  EXPECT_DOUBLE_EQ(layer_height(0, 16), 1.0 / 16);
  EXPECT_DOUBLE_EQ(layer_height(15, 16), 1.0);
  EXPECT_DOUBLE_EQ(layer_height(-1, 16), 0.0);
}

TEST(ReferenceLayers, TheCurveStartsAtTheRootAndEndsAtTheTip) {
  EXPECT_EQ(bezier(a, b, 0), glm::dvec3(0));
  EXPECT_EQ(bezier(a, b, 1), b);
  EXPECT_LT(distance(bezier(a, b, .5), .5 * a + .25 * b), 1e-16);
  // The control points of the curve are the root, the point root + a, and the tip root + b. The curve leaves
  // the root in the direction of a, and reaches the tip in the direction of b - a.
  EXPECT_LT(distance(bezier(a, b, 1e-7) / 1e-7, 2.0 * a), 1e-7);
  EXPECT_LT(distance((bezier(a, b, 1) - bezier(a, b, 1 - 1e-7)) / 1e-7, 2.0 * (b - a)), 1e-6);
}

TEST(ReferenceLayers, RestHeightsAreQuadraticOnPaperAndLinearWhenUniform) {
  for (const double h : {0.0, .1, .5, .9, 1.0}) {
    EXPECT_LT(distance(bezier(a, a, bezier_parameter(h, "paper")), (1 - (1 - h) * (1 - h)) * a), 1e-16);
    EXPECT_LT(distance(bezier(a, a, bezier_parameter(h, "uniform")), h * a), 1e-15);
  }
}

TEST(ReferenceLayers, CurlVanishesAtTheRootAndWhereSoaked) {
  EXPECT_EQ(curl(0, .3, .05, 2, u, v), glm::dvec3(0));
  EXPECT_EQ(curl(.7, 1, .05, 2, u, v), glm::dvec3(0));
}

TEST(ReferenceLayers, CurlIsASpiralOfTheGivenRadiusAndTurns) {
  EXPECT_LT(distance(curl(1, 0, .05, 2, u, v), .05 * u), 1e-15);
  EXPECT_LT(distance(curl(.25, 0, .05, 1, u, v), .05 * .25 * v), 1e-15);
  EXPECT_LT(distance(curl(.5, .4, .05, 1, u, v), -.6 * .05 * .5 * u), 1e-15);
  for (const double h : {.2, .6})
    EXPECT_NEAR(glm::length(curl(h, .25, .05, 3.3, u, v)), .75 * .05 * h, 1e-15);
}

TEST(ReferenceLayers, WetPointsDoNotCurl) {
  Scene scene = synthetic::lively_scene();
  scene.wetness.radius = 3;
  scene.wetness.radius_spread = 0;
  scene.wetness.wetness = 1;
  scene.wetness.wetness_spread = 0;
  const FrameInput wet = synthetic::frame(scene, synthetic::torus(), 12, 8, 1);
  scene.curl.radius = 0;
  const FrameInput straight = synthetic::frame(scene, synthetic::torus(), 12, 8, 0);
  const Geometry curled(wet, wetness_mask(wet), 3), plain(straight, wetness_mask(straight), 3);
  for (std::size_t s = 0; s < curled.slots(); ++s)
    EXPECT_LT(distance(curled.position(s, 9), plain.position(s, 9)), 1e-15);
}

TEST(ReferenceLayers, TheOutermostLayerIsTheMeanOfTheTipsAround) {
  Scene scene = synthetic::lively_scene();
  scene.curl.radius = 0;
  const FrameInput input = synthetic::frame(scene, synthetic::torus(), 12, 8, 0);
  const Geometry geometry(input, wetness_mask(input), 5);
  const std::vector<Strand> strands = simulate(input, 5);
  const Mesh& mesh = *input.mesh;
  for (std::size_t s = 0; s < geometry.slots(); ++s) {
    glm::dvec3 mean(0);
    double area_sum = 0;
    for (std::size_t f = 0; f < mesh.triangle.size(); ++f)
      for (int c = 0; c < 3; ++c)
        if (mesh.weld[mesh.triangle[f][c]] == mesh.weld[geometry.vertex(s)]) {
          const glm::dvec3 p(mesh.position[mesh.triangle[f].x]), q(mesh.position[mesh.triangle[f].y]),
              r(mesh.position[mesh.triangle[f].z]);
          const double area = glm::length(glm::cross(q - p, r - p));
          mean += area * strands[f].tip;
          area_sum += area;
        }
    EXPECT_LT(
        distance(geometry.position(s, 15), glm::dvec3(mesh.position[geometry.vertex(s)]) + mean / area_sum),
        1e-7);
  }
}

TEST(ReferenceLayers, SharedShellsHoldTogetherAndSeparateOnesFollowTheirOwnStrand) {
  Scene scene = synthetic::lively_scene();
  const FrameInput shared = synthetic::frame(scene, synthetic::torus(), 12, 8, 20);
  const Geometry together(shared, wetness_mask(shared), 4);
  std::vector<glm::dvec3> at(shared.mesh->welded, glm::dvec3(1e9));
  for (std::size_t s = 0; s < together.slots(); ++s) {  // vertices at one surface point must coincide
    glm::dvec3& first = at[shared.mesh->weld[together.vertex(s)]];
    if (first.x > 1e8) first = together.position(s, 11);
    EXPECT_LT(distance(together.position(s, 11), first), 1e-15);
  }
  scene.fur.binding = "separate";
  scene.curl.radius = 0;
  const FrameInput separate = synthetic::frame(scene, synthetic::torus(), 12, 8, 20);
  const Geometry apart(separate, wetness_mask(separate), 4);
  const std::vector<Strand> strands = simulate(separate, 4);
  const std::vector<glm::dvec3> corners = layer_positions(separate, apart, 15);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 base(separate.mesh->position[separate.mesh->triangle[i / 3][int(i % 3)]]);
    EXPECT_LT(distance(corners[i], base + strands[i / 3].tip), 1e-15);
  }
}

TEST(ReferenceLayers, OnlyTheWantedFacesMoveAndTheyMoveAlike) {
  const FrameInput input = synthetic::frame(synthetic::lively_scene(), synthetic::torus(), 12, 8, 20);
  std::vector<char> wanted(input.mesh->triangle.size(), 0);
  wanted[17] = wanted[90] = 1;
  const Geometry all(input, wetness_mask(input), 6), some(input, wetness_mask(input), 6, wanted);
  for (const std::size_t face : {17u, 90u})
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_TRUE(some.wanted(some.slot(face, c)));
      EXPECT_EQ(all.position(all.slot(face, c), 8), some.position(some.slot(face, c), 8));
    }
}

TEST(ReferenceLayers, ChordsAddUpToTheTip) {
  FrameInput input = synthetic::frame(synthetic::lively_scene(), synthetic::square(1), 1, 1, 0);
  for (const char* spacing : {"paper", "uniform"}) {
    input.scene.fur.layer_spacing = spacing;
    glm::dvec3 sum(0);
    for (int n = 0; n < 16; ++n) {
      sum += chord(input, {a, b}, n);
      // The arguments {a, b} are the control points of the strand's Bezier curve. For a strand at rest, both
      // control points are equal, and the derivative of the curve is 0 at the tip. The chord is the vector
      // between the strand's positions in two adjacent layers. It must not be 0, even at the tip.
      EXPECT_GT(glm::length(chord(input, {a, a}, n)), 0);
    }
    EXPECT_LT(distance(sum, b), 1e-15);
  }
}

/// Returns the root mean square of the difference between the pictures with N and with 2N layers.
double change_with_layers(int layers, const std::string& correction) {
  Scene scene;
  scene.model = "square";
  scene.image = {.width = 64, .height = 48};
  scene.fur.texture = 64;
  scene.fur.layer_correction = correction;
  const auto mesh = load_scene_mesh(scene, {});
  const auto drawn = [&](int count) {
    scene.fur.layers = count;
    return render(*prepare(scene, mesh), {});
  };
  const Picture few = drawn(layers), many = drawn(2 * layers);
  double sum = 0;
  for (std::size_t i = 0; i < few.pixel.size(); ++i) {
    const glm::dvec4 d = glm::dvec4(few.pixel[i]) - glm::dvec4(many.pixel[i]);
    sum += glm::dot(d, d);
  }
  return std::sqrt(sum / double(few.pixel.size()));
}

// If the pictures converge with first order, twice as many layers halve the change.
TEST(ReferenceLayers, PicturesConvergeOnlyIfFragmentsAreCorrected) {
  const double at_32 = change_with_layers(32, "fragment"), at_64 = change_with_layers(64, "fragment"),
               at_128 = change_with_layers(128, "fragment");
  EXPECT_LT(at_64, 0.7 * at_32);
  EXPECT_LT(at_128, 0.7 * at_64);
  EXPECT_GT(change_with_layers(128, "texel"), 0.7 * change_with_layers(64, "texel"));
}

}  // namespace
}  // namespace pelage
