// Compares Eq. 2 and 3 of paper S with closed forms (docs/shells.md, section 1). Lengths are in R.
#include "harness/shells/reference/strands.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/shells/reference/layers.hpp"
#include "harness/shells/reference/reference.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

using reference::Strand;

/// Returns a frame with upright strands on the plane z = 0, without drag, gravity or wind. The tests use only
/// strand 0.
FrameInput one_strand() {
  Scene scene = synthetic::upright_scene();
  scene.fur.length = .1f;
  scene.dynamics.drag = 0;
  return synthetic::frame(scene, synthetic::square(1), 1, 1, 0);
}

double apart(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(a - b);
}

/// Returns the mean time in s between the moments at which `coordinate` rises above `level`, over `periods`
/// periods. The function interpolates these moments linearly.
template <class Coordinate>
double period(const FrameInput& input, Strand strand, double level, int periods,
              const Coordinate& coordinate) {
  const double dt = double(input.scene.dynamics.step);
  std::vector<double> crossings;
  double before = coordinate(strand);
  for (std::size_t i = 0; i < 100000 && int(crossings.size()) <= periods; ++i) {
    strand = reference::substep(input, 0, strand, i);
    const double now = coordinate(strand);
    if (before < level && now >= level)
      crossings.push_back((double(i) + (level - before) / (now - before)) * dt);
    before = now;
  }
  return (crossings.back() - crossings.front()) / double(crossings.size() - 1);
}

double natural_period(const FrameInput& input) {
  return 2 * std::numbers::pi *
         std::sqrt(double(input.scene.dynamics.mass) / double(input.scene.dynamics.stiffness));
}

TEST(ReferenceStrands, RestStaysAtRest) {
  FrameInput input = one_strand();
  for (const float comb : {0.f, .7f}) {
    input.scene.fur.comb = comb;
    input.strands.anchor[0] = glm::vec3(.1 * glm::normalize(glm::dvec3(comb, 0, 1)));
    const Strand strand = reference::simulate(input, 0, 200);
    // The anchor is rounded to float. It may therefore be outside the ball of Eq. 3 of paper S by a rounding
    // error.
    EXPECT_LT(apart(strand.tip, input.strands.anchor[0]), 2e-8);
    EXPECT_LT(glm::length(strand.velocity), 1e-6);
  }
}

TEST(ReferenceStrands, LoadInsideTheBallMovesTheRestPositionByForceOverStiffness) {
  FrameInput input = one_strand();
  input.scene.dynamics.drag = .02f;
  input.scene.dynamics.gravity = {5, -3, -12};
  const glm::dvec3 expected = glm::dvec3(input.strands.anchor[0]) +
                              double(input.scene.dynamics.mass) * glm::dvec3(input.scene.dynamics.gravity) /
                                  double(input.scene.dynamics.stiffness);
  ASSERT_LT(glm::length(expected), .1);
  ASSERT_GT(expected.z, 0);
  EXPECT_LT(apart(reference::simulate(input, 0, 1000).tip, expected), 1e-9);
}

TEST(ReferenceStrands, LoadOutsideTheBallTurnsTheStrandTowardsTheResultant) {
  FrameInput input = one_strand();
  input.scene.dynamics.drag = .02f;
  for (const glm::vec3 gravity : {glm::vec3(30, 0, 0), glm::vec3(-10, 25, 8), glm::vec3(0, 0, 50)}) {
    input.scene.dynamics.gravity = gravity;
    const glm::dvec3 n(input.strands.normal[0]);
    const double length = double(input.scene.fur.length), k = double(input.scene.dynamics.stiffness);
    const glm::dvec3 force = double(input.scene.dynamics.mass) * glm::dvec3(gravity);
    ASSERT_GT(glm::length(length * n + force / k), length);
    EXPECT_LT(apart(reference::simulate(input, 0, 1000).tip, length * glm::normalize(k * length * n + force)),
              1e-8);
  }
}

TEST(ReferenceStrands, LoadIntoTheSkinRestsOnIt) {
  FrameInput input = one_strand();
  input.scene.dynamics.drag = .02f;
  input.scene.dynamics.gravity = {20, 8, -70};
  const glm::dvec3 free = glm::dvec3(input.strands.anchor[0]) + double(input.scene.dynamics.mass) *
                                                                    glm::dvec3(input.scene.dynamics.gravity) /
                                                                    double(input.scene.dynamics.stiffness);
  ASSERT_LT(free.z, 0);
  EXPECT_LT(apart(reference::simulate(input, 0, 1000).tip, {free.x, free.y, 0}), 1e-9);
}

TEST(ReferenceStrands, SteadyWindIsAForceAndItsGustAWaveAlongTheWind) {
  FrameInput input = one_strand();
  DynamicsScene& dynamics = input.scene.dynamics;
  dynamics.wind = {{0, 0, -2}, .008f, 0, 1, 2};  // the length of the direction vector has no effect
  dynamics.drag = .02f;
  EXPECT_LT(apart(reference::simulate(input, 0, 1000).tip, {0, 0, .1 - .008 / .4}), 1e-8);
  // The force of the wind is strength * (1 + gust * sin(2 pi frequency t - phase)) with the phase .7. At the
  // time 0, the sine is -sin(phase). After a substep of 1/240 s from rest, the velocity is the force divided
  // by the mass and by 240.
  dynamics.wind.gust = .5f;
  input.strands.phase[0] = {float(std::cos(.7)), float(std::sin(.7))};
  const Strand first = reference::substep(input, 0, reference::rest(input, 0), 0);
  EXPECT_NEAR(first.velocity.z, -.008 * (1 - .5 * std::sin(.7)) / .001 / 240, 1e-7);
  // After 16 substeps of 1/240 s, a quarter of the gust's period of 16/60 s has passed. The sine is then
  // sin(pi/2 - phase) = cos(phase).
  dynamics.wind.frequency = 60.f / 16;
  const Strand later = reference::substep(input, 0, reference::rest(input, 0), 16);
  EXPECT_NEAR(later.velocity.z, -.008 * (1 + .5 * std::cos(.7)) / .001 / 240, 1e-7);
}

TEST(ReferenceStrands, DragDampsAsTheExponentialSays) {
  FrameInput input = one_strand();
  input.scene.dynamics.stiffness = 0;
  input.scene.dynamics.drag = .01f;
  input.scene.dynamics.step = 1e-5f;
  Strand strand{{0, 0, .05}, {.1, 0, 0}};
  for (std::size_t i = 0; i < 10000; ++i) strand = reference::substep(input, 0, strand, i);
  EXPECT_NEAR(strand.velocity.x, .1 * std::exp(-.01 / .001 * .1), 1e-5);
}

TEST(ReferenceStrands, SmallTangentialSwingsHaveTheSpringsPeriod) {
  const FrameInput input = one_strand();
  const Strand start{.1 * glm::dvec3(std::sin(.3), 0, std::cos(.3)), glm::dvec3(0)};
  const double measured = period(input, start, 0, 1, [](const Strand& s) { return s.tip.x; });
  EXPECT_NEAR(measured / natural_period(input), 1, .01);
}

TEST(ReferenceStrands, SwingsFromAnInwardPreloadHaveTheSpringsPeriod) {
  FrameInput input = one_strand();
  input.scene.dynamics.gravity = {0, 0, -10};  // the tip is in equilibrium .075 above the skin
  const Strand start{{0, 0, .06}, glm::dvec3(0)};
  const double measured = period(input, start, .075, 20, [](const Strand& s) { return s.tip.z; });
  EXPECT_NEAR(measured / natural_period(input), 1, .001);
}

TEST(ReferenceStrands, RadialReleaseStopsDeadOnTheBall) {
  const FrameInput input = one_strand();
  Strand strand{{0, 0, .05}, glm::dvec3(0)};
  for (std::size_t i = 0; i < 200; ++i) strand = reference::substep(input, 0, strand, i);
  EXPECT_LT(apart(strand.tip, {0, 0, double(.1f)}), 1e-9);
  EXPECT_LT(glm::length(strand.velocity), 1e-9);
}

TEST(ReferenceStrands, Equation3HoldsUnderRandomForces) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1, 1);
  FrameInput input = one_strand();
  const double length = double(input.scene.fur.length);
  double highest = 0, lowest = 1;
  for (int trial = 0; trial < 300; ++trial) {
    const glm::vec3 n(glm::normalize(glm::dvec3(any(random), any(random), any(random))));
    input.strands.normal[0] = n;
    input.strands.anchor[0] = input.scene.fur.length * n;
    Strand strand = reference::rest(input, 0);
    for (std::size_t i = 0; i < 200; ++i) {
      input.scene.dynamics.gravity = 200.f * glm::vec3(any(random), any(random), any(random));
      input.scene.dynamics.wind = {{any(random), any(random), any(random)}, any(random), 1, 3, 1};
      strand = reference::substep(input, 0, strand, i);
      highest = std::max(highest, glm::length(strand.tip) / length);
      lowest = std::min(lowest, glm::dot(strand.tip, glm::dvec3(n)) / length);
    }
  }
  EXPECT_LE(highest, 1 + 1e-12);
  // A tip may be slightly below the surface. The normal n is rounded to floats, so its length differs from 1
  // by up to 6e-8. The projection of the tip onto the surface is therefore not exact.
  EXPECT_GE(lowest, -1e-7);
  EXPECT_GT(highest, 1 - 1e-12);  // some tips must reach the fur's length, and some the skin
  EXPECT_LT(lowest, 1e-7);
}

TEST(ReferenceStrands, TheProjectionTakesOnlyWhatLeaves) {
  const glm::dvec3 n(0, 0, 1);
  const Strand inside{{.01, 0, .02}, {9, 9, 9}};
  EXPECT_EQ(reference::constrain(inside, n, .1).tip, inside.tip);
  EXPECT_EQ(reference::constrain(inside, n, .1).velocity, inside.velocity);
  const Strand below = reference::constrain({{.03, 0, -.02}, {1, 2, -3}}, n, .1);
  EXPECT_LT(apart(below.tip, {.03, 0, 0}) + apart(below.velocity, {1, 2, 0}), 1e-15);
  const Strand rising = reference::constrain({{.03, 0, -.02}, {1, 2, 3}}, n, .1);
  EXPECT_LT(apart(rising.velocity, {1, 2, 3}), 1e-15);
  const Strand outside = reference::constrain({{0, .06, .08 * 1.0 + .04}, {0, 0, 0}}, n, .1);
  EXPECT_NEAR(glm::length(outside.tip), .1, 1e-15);
  const Strand leaving = reference::constrain({{.2, 0, 0}, {3, 4, 0}}, n, .1);
  EXPECT_LT(apart(leaving.tip, {.1, 0, 0}) + apart(leaving.velocity, {0, 4, 0}), 1e-15);
  const Strand both = reference::constrain({{.3, 0, -.4}, {1, 1, -1}}, n, .1);
  EXPECT_LT(apart(both.tip, {.1, 0, 0}) + apart(both.velocity, {0, 1, 0}), 1e-15);
}

// Tests Eq. 1 and 4 of paper S and the strand's curve (docs/shells.md, section 3).

using namespace reference;

const glm::dvec3 a(.02, -.03, .09), b(.05, .06, .04), u(1, 0, 0), v(0, 1, 0);

TEST(ReferenceLayers, HeightsRunFromOneNthToOne) {
  EXPECT_DOUBLE_EQ(layer_height(0, 16), 1.0 / 16);
  EXPECT_DOUBLE_EQ(layer_height(15, 16), 1.0);
  EXPECT_DOUBLE_EQ(layer_height(-1, 16), 0.0);
}

TEST(ReferenceLayers, TheCurveStartsAtTheRootAndEndsAtTheTip) {
  EXPECT_EQ(bezier(a, b, 0), glm::dvec3(0));
  EXPECT_EQ(bezier(a, b, 1), b);
  EXPECT_LT(apart(bezier(a, b, .5), .5 * a + .25 * b), 1e-16);
  // The control points of the curve are the root, the point root + a, and the tip root + b. The curve leaves
  // the root in the direction of a, and reaches the tip in the direction of b - a.
  EXPECT_LT(apart(bezier(a, b, 1e-7) / 1e-7, 2.0 * a), 1e-7);
  EXPECT_LT(apart((bezier(a, b, 1) - bezier(a, b, 1 - 1e-7)) / 1e-7, 2.0 * (b - a)), 1e-6);
}

TEST(ReferenceLayers, RestHeightsAreQuadraticOnPaperAndLinearWhenUniform) {
  for (const double h : {0.0, .1, .5, .9, 1.0}) {
    EXPECT_LT(apart(bezier(a, a, bezier_parameter(h, "paper")), (1 - (1 - h) * (1 - h)) * a), 1e-16);
    EXPECT_LT(apart(bezier(a, a, bezier_parameter(h, "uniform")), h * a), 1e-15);
  }
}

TEST(ReferenceLayers, CurlVanishesAtTheRootAndWhereSoaked) {
  EXPECT_EQ(curl(0, .3, .05, 2, u, v), glm::dvec3(0));
  EXPECT_EQ(curl(.7, 1, .05, 2, u, v), glm::dvec3(0));
}

TEST(ReferenceLayers, CurlIsASpiralOfTheGivenRadiusAndTurns) {
  EXPECT_LT(apart(curl(1, 0, .05, 2, u, v), .05 * u), 1e-15);
  EXPECT_LT(apart(curl(.25, 0, .05, 1, u, v), .05 * .25 * v), 1e-15);
  EXPECT_LT(apart(curl(.5, .4, .05, 1, u, v), -.6 * .05 * .5 * u), 1e-15);
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
    EXPECT_LT(apart(curled.position(s, 9), plain.position(s, 9)), 1e-15);
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
        apart(geometry.position(s, 15), glm::dvec3(mesh.position[geometry.vertex(s)]) + mean / area_sum),
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
    EXPECT_LT(apart(together.position(s, 11), first), 1e-15);
  }
  scene.fur.binding = "separate";
  scene.curl.radius = 0;
  const FrameInput separate = synthetic::frame(scene, synthetic::torus(), 12, 8, 20);
  const Geometry alone(separate, wetness_mask(separate), 4);
  const std::vector<Strand> strands = simulate(separate, 4);
  for (std::size_t i = 0; i < 3 * separate.mesh->triangle.size(); ++i) {
    const glm::dvec3 base(separate.mesh->position[separate.mesh->triangle[i / 3][int(i % 3)]]);
    EXPECT_LT(apart(alone.position(alone.slot(i / 3, i % 3), 15), base + strands[i / 3].tip), 1e-15);
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
    EXPECT_LT(apart(sum, b), 1e-15);
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
