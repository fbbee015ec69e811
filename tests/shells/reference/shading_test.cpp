// Tests S Eq. 6 and W Eq. 2 to 5. The light is along or across the strand, and the equations' constants have
// extreme values. T is the strand's direction, L the direction to the light, and E that from the eye.
#include "harness/shells/reference/shading.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pelage {
namespace {

using namespace reference;

const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), coat(.8, .6, .4);

/// Returns constants for the papers' equations without our additions: no ambient light and no wrapped light.
/// There is one light of intensity 2 in the direction +z.
ShadingScene bare() {
  ShadingScene shading;
  shading.lights = {LightScene{{0, 0, 3}, 2}};
  shading.wrap = 0;
  shading.ambient = 0;
  shading.specular = {.5f, .5f, .5f};
  shading.exponent = 8;
  shading.shadow = 2;
  shading.occlusion = .5f;
  shading.darkening = .25f;
  shading.wet_specular = .5f;
  return shading;
}

Fragment seen(const glm::dvec3& tangent, const glm::dvec3& normal, const glm::dvec3& view) {
  return {coat, tangent, normal, view, 1, 0};
}

void expect_colour(const glm::dvec3& c, const glm::dvec3& expected, double tolerance = 1e-7) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(c[i], expected[i], tolerance);
}

TEST(ReferenceCurling, AlongTheLightAStrandIsDark) {
  expect_colour(curling_colour(bare(), seen(z, z, x)), glm::dvec3(0));
  expect_colour(curling_colour(bare(), seen(-z, z, y)), glm::dvec3(0));
}

TEST(ReferenceCurling, AcrossTheLightAStrandIsFullyLitAndShinesAcrossTheView) {
  // In Eq. 6 of paper S, |T x L| = 1, so the strand has the full diffuse light. T.L = 0 and |T x E| = 1, so
  // the highlight is 1.
  expect_colour(curling_colour(bare(), seen(x, z, y)), 2.0 * coat + glm::dvec3(2 * .5));
  // With the view along the strand there is no highlight.
  expect_colour(curling_colour(bare(), seen(x, z, x)), 2.0 * coat);
}

TEST(ReferenceCurling, TheHighlightIsTheMirrorCone) {
  // The view direction E points from the eye to the surface. The highlight is strongest if E and the light
  // direction L have the same angle to the strand's direction T.
  const double t = .7;
  const glm::dvec3 tangent(std::sin(t), 0, std::cos(t));  // a strand at the angle t to the light
  for (const double e : {.1, .7, 1.3}) {
    const glm::dvec3 view = std::cos(e) * tangent + std::sin(e) * y;
    const double highlight = std::pow(std::cos(t - e), 8);
    expect_colour(curling_colour(bare(), seen(tangent, z, view)),
                  2 * std::sin(t) * coat + glm::dvec3(2 * .5 * highlight));
  }
  // The view direction is opposite to the strand's direction, so the base of the highlight's power is
  // negative and clamped to 0.
  const glm::dvec3 back = -tangent;
  expect_colour(curling_colour(bare(), seen(tangent, z, back)), 2 * std::sin(t) * coat);
}

TEST(ReferenceCurling, ShadowDarkensTheRoot) {
  Fragment root = seen(x, z, x), middle = root;
  root.height = 0;
  middle.height = .5;
  expect_colour(curling_colour(bare(), root), .5 * 2.0 * coat);
  expect_colour(curling_colour(bare(), middle), .75 * 2.0 * coat);
  ShadingScene strongest = bare();
  strongest.shadow = 1;
  expect_colour(curling_colour(strongest, root), glm::dvec3(0));
}

TEST(ReferenceCurling, AmbientAndWrapAreAdditionsThatZeroTakesAway) {
  ShadingScene shading = bare();
  shading.ambient = .25f;
  expect_colour(curling_colour(shading, seen(z, z, x)), .25 * coat);
  shading = bare();
  shading.wrap = 1;
  expect_colour(curling_colour(shading, seen(x, z, x)), 2.0 * coat);             // n.L = 1: full light
  expect_colour(curling_colour(shading, seen(x, -z, x)), glm::dvec3(0));         // n.L = -1: no light
  expect_colour(curling_colour(shading, seen(x, y, x)), 2.0 * .4 / 1.4 * coat);  // n.L = 0
  shading.wrap = .5f;
  expect_colour(curling_colour(shading, seen(x, -z, x)), 1.0 * coat);
}

TEST(ReferenceCurling, LightsAddUp) {
  ShadingScene shading = bare();
  shading.lights.push_back(LightScene{{1, 0, 0}, .5f});
  expect_colour(curling_colour(shading, seen(y, z, y)), 2.5 * coat);
}

TEST(ReferenceWet, DiffuseIsTheSurfacesOwn) {
  ShadingScene shading = bare();
  shading.specular = glm::vec3(0);
  for (const double t : {0.0, .5, 1.2})
    expect_colour(wet_colour(shading, seen(x, {std::sin(t), 0, std::cos(t)}, x)), 2 * std::cos(t) * coat);
  expect_colour(wet_colour(shading, seen(x, -z, x)), glm::dvec3(0));
  shading.wrap = 1;
  expect_colour(wet_colour(shading, seen(x, y, x)), 2 * .4 / 1.4 * coat);
  shading.ambient = .25f;
  shading.wrap = .5f;
  expect_colour(wet_colour(shading, seen(x, y, x)), (.25 + 2 * .5 * .4 / 1.4) * coat);
}

TEST(ReferenceWet, WetnessSharpensTheHighlight) {
  ShadingScene shading = bare();
  shading.darkening = 0;
  const double t = .7, e = 1.2;
  const glm::dvec3 tangent(std::sin(t), 0, std::cos(t)), view = std::cos(e) * tangent + std::sin(e) * y;
  const auto highlight = [&](double exponent) {
    return glm::dvec3(2 * .5 * std::pow(std::cos(t - e), exponent));
  };
  Fragment fragment = seen(tangent, z, view);
  for (const double rho : {0.0, .5, 1.0}) {
    fragment.wetness = rho;
    expect_colour(wet_colour(shading, fragment), 2.0 * coat + highlight((1 + .5 * (rho - 1)) * 8));
  }
  shading.wet_specular = 0;  // with sigma_spec = 0, wetness does not change the exponent
  fragment.wetness = 0;
  expect_colour(wet_colour(shading, fragment), 2.0 * coat + highlight(8));
}

TEST(ReferenceWet, OcclusionAndDarkeningAreTheirFactors) {
  Fragment fragment = seen(x, z, x);
  expect_colour(wet_colour(bare(), fragment), 2.0 * coat);
  fragment.height = 0;
  expect_colour(wet_colour(bare(), fragment), .5 * 2.0 * coat);
  fragment.wetness = 1;
  expect_colour(wet_colour(bare(), fragment), .5 * .75 * 2.0 * coat);
  ShadingScene none = bare();
  none.occlusion = none.darkening = 0;
  expect_colour(wet_colour(none, fragment), 2.0 * coat);
}

TEST(ReferenceWet, TheTangentLeansWithTheClump) {
  Scene scene;
  scene.shading = bare();
  scene.fur.layers = 20;
  const glm::dvec3 bend(0, 0, .3), t(4, 0, 0), b(0, 2, 0);
  const auto tangent = [&](glm::dvec2 delta_d, glm::dvec2 moved = glm::dvec2(0)) {
    Displacement clump;
    clump.delta_d = delta_d;
    clump.moved = moved;
    return wet_tangent(scene, bend, t, b, z, clump);
  };
  scene.shading.tangent = "paper";
  expect_colour(tangent({0, 0}), z);
  expect_colour(tangent({.1, 0}), {.8, 0, .6});  // (.4, 0, .3) in R
  expect_colour(tangent({0, -.2}), {0, -.8, .6});
  scene.shading.tangent = "drawn";
  expect_colour(tangent({.1, 0}), {-.8, 0, .6});
  scene.shading.tangent = "strand";
  expect_colour(tangent({.3, .3}, {0, .2}), {0, .8, .6});
  // The printed units: .0375 in UV, and a height of 1/20 = .05.
  scene.shading.tangent = "printed";
  expect_colour(tangent({.0375, 0}), {.6, 0, .8});
}

TEST(ReferenceSkin, IsTheWetModelsDiffuseTermAtTheRoot) {
  ShadingScene shading = bare();
  const Fragment fragment{coat, z, z, x, 0, .4};
  shading.model = "curling";
  expect_colour(skin_colour(shading, fragment), .5 * 2.0 * coat);
  shading.model = "wet";
  expect_colour(skin_colour(shading, fragment), .5 * (1 - .25 * .4) * 2.0 * coat);
}

TEST(ReferenceTwoSided, LightReachesTheSideThatFacesTheEye) {
  ShadingScene one = bare(), two = bare();
  two.sides = "two";
  // The surface normal is the z axis. The view direction points from the eye to the surface. If its z
  // component is positive, the normal points away from the eye.
  for (const double tilt : {.1, .8, 1.5}) {
    const glm::dvec3 away(std::cos(tilt), 0, std::sin(tilt)), towards(std::cos(tilt), 0, -std::sin(tilt));
    expect_colour(lit_normal(one, z, away), z);
    expect_colour(lit_normal(one, z, towards), z);
    expect_colour(lit_normal(two, z, away), -z);
    expect_colour(lit_normal(two, z, towards), z);
  }
}

}  // namespace
}  // namespace pelage
