// Compiles the kernels' functions for the equations of S and W as C++ in double precision, and compares them
// with closed forms and with the reference. The device runs them in single precision: only rounding differs.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/shells/reference/layers.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/shading.hpp"
#include "harness/shells/reference/strands.hpp"
#include "harness/shells/reference/textures.hpp"
#include "tests/support/opencl_as_cpp.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::in_double {
// clang-format off
#include "simulate/equations.clh"
#include "wet/equations.clh"
#include "rasterize/equations.clh"
// clang-format on
}  // namespace pelage::in_double

namespace pelage {
namespace {

namespace shim = in_double;
using shim::real3;
using synthetic::Any;

constexpr double tight = 1e-12;

glm::dvec3 to_glm(const real3& v) {
  return {v.x, v.y, v.z};
}
real3 in_shim(const glm::dvec3& v) {
  return shim::vec3(v.x, v.y, v.z);
}

void expect_within(const glm::dvec3& a, const glm::dvec3& b, double tolerance = tight) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

/// Returns the kernels' parameters for the scene of `input`.
shim::SimulateParams simulate_params(const FrameInput& input) {
  const DynamicsScene& dynamics = input.scene.dynamics;
  const glm::vec3 wind = dynamics.wind.strength * glm::normalize(dynamics.wind.direction);
  const glm::vec3 weight = dynamics.mass * dynamics.gravity;
  shim::SimulateParams p{};
  p.stiffness = dynamics.stiffness;
  p.drag = dynamics.drag;
  p.inverse_mass = 1 / dynamics.mass;
  p.step = dynamics.step;
  p.length = input.scene.fur.length;
  p.gust = dynamics.wind.gust;
  p.weight_x = weight.x, p.weight_y = weight.y, p.weight_z = weight.z;
  p.wind_x = wind.x, p.wind_y = wind.y, p.wind_z = wind.z;
  return p;
}

shim::Strand stepped(const FrameInput& input, const shim::Strand& strand, double time) {
  const shim::SimulateParams p = simulate_params(input);
  const double turn = 2 * std::numbers::pi * double(input.scene.dynamics.wind.frequency) * time;
  const glm::dvec2 phase(input.strands.phase[0]);
  const real3 force = shim::forces(p, strand, in_shim(input.strands.anchor[0]), phase.x, phase.y,
                                   std::sin(turn), std::cos(turn));
  return shim::constrained(p, shim::accelerated(p, strand, force), in_shim(input.strands.normal[0]));
}

FrameInput one_strand() {
  Scene scene = synthetic::lively_scene();
  scene.fur.length = .1f;
  return synthetic::frame(scene, synthetic::square(1), 1, 1, 0);
}

TEST(Equations, StrandsStepLikeTheReference) {
  FrameInput input = one_strand();
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    Any any{trial};
    const glm::dvec3 n = any.direction();
    input.strands.normal[0] = n;
    input.strands.anchor[0] = .1 * glm::normalize(n + .5 * any.vector());
    input.strands.phase[0] = {float(std::cos(trial)), float(std::sin(trial))};
    input.scene.dynamics.gravity = 50.0 * any.vector();
    input.scene.dynamics.wind = {any.vector(), float(.05 * any()), float(any()), 3, 1};
    shim::Strand strand{in_shim(input.strands.anchor[0]), in_shim(glm::dvec3(0))};
    reference::Strand expected = reference::rest(input, 0);
    for (std::size_t i = 0; i < 40; ++i) {
      strand = stepped(input, strand, double(i) * double(input.scene.dynamics.step));
      expected = reference::substep(input, 0, expected, i);
      // The parameters are floats, so wind, weight and 1/m (m is the mass) are rounded before they are used.
      // The motion amplifies this rounding error.
      ASSERT_LT(glm::length(to_glm(strand.tip) - expected.tip), 1e-6) << trial << ' ' << i;
      ASSERT_LT(glm::length(to_glm(strand.speed) - expected.velocity), 1e-4) << trial << ' ' << i;
    }
  }
}

TEST(Equations, Equation3HoldsUnderRandomForces) {
  FrameInput input = one_strand();
  const double length = double(input.scene.fur.length);
  for (std::uint32_t trial = 0; trial < 300; ++trial) {
    Any any{trial};
    const glm::dvec3 n = glm::dvec3(glm::vec3(any.direction()));
    input.strands.normal[0] = n;
    input.strands.anchor[0] = .1 * n;
    shim::Strand strand{in_shim(input.strands.anchor[0]), in_shim(glm::dvec3(0))};
    for (int i = 0; i < 100; ++i) {
      input.scene.dynamics.gravity = 300.0 * any.vector();
      strand = stepped(input, strand, i);
      ASSERT_LE(glm::length(to_glm(strand.tip)),
                length * (1 + 1e-7));  // the kernel rounds the squared strand length to a float
      ASSERT_GE(glm::dot(to_glm(strand.tip), n),
                -1e-7 * length);  // the length of n is 1 up to float rounding
    }
  }
}

TEST(Equations, RestPositionsAreTheClosedForms) {
  FrameInput input = one_strand();
  input.scene.dynamics.drag = .02f;
  input.scene.dynamics.wind.strength = 0;
  input.scene.fur.comb = 0;
  input.strands.anchor[0] = {0, 0, .1f};
  const double length = double(input.scene.fur.length), k = double(input.scene.dynamics.stiffness);
  for (const glm::vec3 gravity :
       {glm::vec3(0), glm::vec3(4, 2, -12), glm::vec3(30, -10, 5), glm::vec3(9, 0, -60)}) {
    input.scene.dynamics.gravity = gravity;
    shim::Strand strand{in_shim(input.strands.anchor[0]), in_shim(glm::dvec3(0))};
    for (int i = 0; i < 4000; ++i) strand = stepped(input, strand, 0);
    const glm::dvec3 force = double(input.scene.dynamics.mass) * glm::dvec3(gravity), n(0, 0, 1);
    glm::dvec3 expected = length * n + force / k;
    if (expected.z < 0) expected.z = 0;
    if (glm::length(expected) > length) expected = length * glm::normalize(k * length * n + force);
    expect_within(to_glm(strand.tip), expected, 1e-7);
  }
}

TEST(Equations, Algorithm1BlendsAndOverwritesLikeTheReference) {
  int blended = 0, overwritten = 0;
  for (std::uint32_t trial = 0; trial < 5000; ++trial) {
    Any any{trial};
    const auto positive = [&] { return std::abs(any()); };
    const reference::Clump texel{{positive(), positive()}, .2 * positive(), trial % 5 ? positive() : 0};
    const Droplet droplet{
        {float(positive()), float(positive())}, float(positive()), float(positive()), {}, 1};
    const bool overlap = trial % 2 == 0;
    const double margin = trial % 3 == 0 ? .01 : 0;
    const reference::Clump expected = reference::blend(texel, droplet, overlap ? "overlap" : "near", margin);
    const shim::Clump result =
        shim::blend_droplet({shim::vec2(texel.centre.x, texel.centre.y), texel.radius, texel.wetness},
                            {shim::vec2(double(droplet.centre.x), double(droplet.centre.y)),
                             double(droplet.radius), double(droplet.wetness)},
                            overlap, margin);
    EXPECT_NEAR(result.centre.x, expected.centre.x, tight);
    EXPECT_NEAR(result.centre.y, expected.centre.y, tight);
    EXPECT_NEAR(result.radius, expected.radius, tight);
    EXPECT_NEAR(result.wetness, expected.wetness, tight);
    (expected.centre == glm::dvec2(droplet.centre) ? overwritten : blended)++;
  }
  EXPECT_GT(blended, 500);
  EXPECT_GT(overwritten, 500);
}

TEST(Equations, TheCurveStartsAtTheRootEndsAtTheTipAndLooksLikeTheReference) {
  const shim::Bezier root = shim::bezier(0), tip = shim::bezier(1);
  EXPECT_EQ(root.toward, 0);
  EXPECT_EQ(root.along, 0);
  EXPECT_EQ(tip.toward, 0);
  EXPECT_EQ(tip.along, 1);
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    Any any{trial};
    const glm::dvec3 a = any.vector(), b = any.vector();
    const double h = std::abs(any());
    EXPECT_NEAR(shim::layer_parameter(h, 0), reference::bezier_parameter(h, "paper"), tight);
    EXPECT_NEAR(shim::layer_parameter(h, 1), reference::bezier_parameter(h, "uniform"), tight);
    const glm::dvec3 phi = any.vector();
    expect_within(to_glm(shim::layer_offset(shim::bezier(h), in_shim(a), in_shim(b), in_shim(phi))),
                  reference::bezier(a, b, h) + phi);
  }
}

TEST(Equations, CurlVanishesAtTheRootAndWhereSoakedAndLooksLikeTheReference) {
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    Any any{trial};
    const glm::dvec3 u = any.direction(), v = glm::normalize(glm::cross(u, any.vector()));
    const double h = std::abs(any()), rho = std::abs(any()), radius = .1 * std::abs(any()), turns = 4 * any();
    const double wh = 2 * std::numbers::pi * turns * h;
    const auto curl = [&](double height, double wetness) {
      return to_glm(
          shim::curl(height, std::cos(wh), std::sin(wh), radius, 1 - wetness, in_shim(u), in_shim(v)));
    };
    expect_within(curl(h, rho), reference::curl(h, rho, radius, turns, u, v));
    expect_within(curl(0, rho), glm::dvec3(0));
    expect_within(curl(h, 1), glm::dvec3(0));
    EXPECT_NEAR(glm::length(curl(h, 0)), radius * h, tight);
  }
}

TEST(Equations, ClumpsShapeIsZeroOnTheFirstLayerAndOneOnTheLast) {
  for (const std::string_view function : clump_functions)
    for (const int layers : {2, 16, 64, 512}) {
      if (function == "logarithmic") {
        EXPECT_NEAR(shim::clump_rate(1.0 / layers, clump_curve(function, 1.0 / layers, layers), 1), 0, tight);
      }
      for (const double w : {0.0, .3, 1.0}) {
        EXPECT_NEAR(shim::clump_rate(1, clump_curve(function, 1, layers), w), 1, tight);
        for (int n = 0; n < layers; ++n) {
          const double h = (1.0 + n) / layers;
          EXPECT_NEAR(shim::clump_rate(h, clump_curve(function, h, layers), w),
                      reference::clump_shape(h, w, layers, function), tight);
        }
      }
    }
  const shim::real2 d = shim::clump_shift(.5, .8, 3.5, shim::vec2(.3, .7), shim::vec2(.2, .9));
  EXPECT_NEAR(d.x, .5 * .8 * 3.5 * .1, tight);
  EXPECT_NEAR(d.y, .5 * .8 * 3.5 * -.2, tight);
}

TEST(Equations, ShiftsByAClumpAreTheReferences) {
  const int layers = 16;
  for (std::uint32_t trial = 0; trial < 400; ++trial) {
    Any any{trial};
    const char* scale = clump_scales[trial % clump_scales.size()];
    FrameInput input;
    input.scene.fur.layers = layers;
    input.scene.clump.scale = scale;
    input.scene.clump.gain = 256;
    input.scene.clump.cells = "literal";
    input.scene.clump.shape = float(std::abs(any()));
    const double w = double(input.scene.clump.shape), rho = std::abs(any()), r = .2 + .1 * any();
    const double distance = .19 * std::abs(any()) + 1e-3;
    const glm::dvec2 away = distance * glm::normalize(glm::dvec2(any(), any()) + 1e-9), centre(.45, .55);
    const int n = int(trial / 4) % layers;
    const auto f = [&](int layer) {
      return layer < 0 ? 0 : reference::clump_shape((1. + layer) / layers, w, layers);
    };
    // A mask with one texel, which the clump covers.
    reference::Mask mask{1, {{centre, r, rho}}};
    const reference::Displacement expected = reference::clump_displacement(input, mask, centre + away, n);
    const bool converging = std::string_view(scale) == "converge";
    const double factor = std::string_view(scale) == "literal" ? 256 * r : r / distance;
    const shim::Shift shift =
        converging ? shim::converging_shift(f(n), f(n) - f(n - 1), rho)
                   : shim::linear_shift(f(n), f(n) - f(n - 1),
                                        std::string_view(scale) == "distance" ? 0 : rho * factor);
    const glm::dvec2 pull = converging ? away : rho * factor * away;
    const auto expect_same = [&](double found, glm::dvec2 value, const char* what) {
      EXPECT_NEAR(found * pull.x, value.x, 1e-9) << scale << ", " << what;
      EXPECT_NEAR(found * pull.y, value.y, 1e-9) << scale << ", " << what;
    };
    expect_same(shift.amount, expected.d, "d");
    expect_same(shift.change, expected.delta_d, "change");
    expect_same(-shift.drawn, expected.moved, "strand");
    EXPECT_NEAR(shift.stretch, expected.stretch, 1e-9 * expected.stretch);
  }
}

/// Returns the factor of the highlight colour C_s in Eq. 6 of paper S. All vectors are unit vectors.
double strand_specular(const real3& tangent, const real3& light, const real3& eye, double exponent) {
  return shim::power(shim::strand_mirror(shim::angle_with(tangent, light), shim::angle_with(tangent, eye)),
                     exponent);
}

/// Returns the colour of Eq. 6 of paper S for one fragment. The function calls the kernels' functions.
glm::dvec3 curling(const ShadingScene& shading, const reference::Fragment& f) {
  double diffuse = double(shading.ambient), specular = 0;
  for (const LightScene& light : shading.lights) {
    const glm::dvec3 l = glm::normalize(glm::dvec3(light.direction));
    const double g =
        double(light.intensity) * shim::wrapped_light(glm::dot(f.normal, l), double(shading.wrap));
    diffuse += g * shim::strand_diffuse(shim::angle_with(in_shim(f.tangent), in_shim(l)));
    specular +=
        g * strand_specular(in_shim(f.tangent), in_shim(l), in_shim(f.view), double(shading.exponent));
  }
  return shim::shadow_factor(f.height, double(shading.shadow)) *
         (diffuse * f.colour + specular * glm::dvec3(shading.specular));
}

glm::dvec3 wet(const ShadingScene& shading, const reference::Fragment& f) {
  double diffuse = double(shading.ambient), specular = 0;
  const double exponent =
      double(shading.exponent) * shim::wet_exponent(f.wetness, double(shading.wet_specular));
  for (const LightScene& light : shading.lights) {
    const glm::dvec3 l = glm::normalize(glm::dvec3(light.direction));
    const double n_dot_l = glm::dot(f.normal, l), wrap = double(shading.wrap);
    diffuse += double(light.intensity) * shim::surface_diffuse(n_dot_l, wrap);
    specular += double(light.intensity) * shim::wrapped_light(n_dot_l, wrap) *
                strand_specular(in_shim(f.tangent), in_shim(l), in_shim(f.view), exponent);
  }
  return shim::occlusion_factor(f.height, double(shading.occlusion)) *
         shim::wet_factor(f.wetness, double(shading.darkening)) *
         (diffuse * f.colour + specular * glm::dvec3(shading.specular));
}

TEST(Equations, ColoursAreTheReferences) {
  for (std::uint32_t trial = 0; trial < 2000; ++trial) {
    Any any{trial};
    ShadingScene shading;
    shading.wrap = trial % 3 ? float(std::abs(any())) : 0;
    shading.exponent = float(1 + 40 * std::abs(any()));
    shading.wet_specular = trial % 4 ? float(.9 * std::abs(any())) : 0;
    shading.occlusion = float(std::abs(any()));
    shading.darkening = float(std::abs(any()));
    shading.shadow = float(1 + std::abs(any()));
    shading.specular = {.25f, .15f, .08f};
    shading.lights = {LightScene{any.vector(), 1.5f}, LightScene{any.vector(), .6f}};
    const reference::Fragment f{any.vector(),    any.direction(), any.direction(),
                                any.direction(), std::abs(any()), trial % 5 ? std::abs(any()) : 0};
    // The kernels compute the wrapped light (x + .4f) / 1.4f with float literals, so the wrapped light is up
    // to 2.2e-8 too large. In the result, this error is multiplied by 2.1, the sum of the light intensities.
    // It is also multiplied by at most 1.25, because each component of the colour is at most 1 and each
    // component of `specular` is at most 0.25. Without wrapped light there is no such error.
    const double tolerance = shading.wrap == 0 ? 1e-11 : 6e-8;
    expect_within(curling(shading, f), reference::curling_colour(shading, f), tolerance);
    expect_within(wet(shading, f), reference::wet_colour(shading, f), tolerance);
  }
}

TEST(Equations, AlongAndAcrossTheLight) {
  const real3 x = shim::vec3(1, 0, 0), y = shim::vec3(0, 1, 0), z = shim::vec3(0, 0, 1);
  // The light is parallel to the strand, so the diffuse light is 0.
  EXPECT_EQ(shim::strand_diffuse(shim::angle_with(z, z)), 0);
  // The light is perpendicular to the strand, so the diffuse light is 1.
  EXPECT_EQ(shim::strand_diffuse(shim::angle_with(x, z)), 1);
  // The light and the view direction are both perpendicular to the strand, so the highlight is 1.
  EXPECT_EQ(strand_specular(x, z, y, 8), 1);
  // The light is perpendicular and the view direction is parallel to the strand, so the highlight is 0.
  EXPECT_EQ(strand_specular(x, z, x, 8), 0);
  // The light and the view direction are both parallel to the strand, so the highlight is 1.
  EXPECT_EQ(strand_specular(z, z, z, 8), 1);
  // The base of the power is -1 here. The kernel clamps a negative base to 0.
  EXPECT_EQ(strand_specular(z, z, shim::vec3(0, 0, -1), 8), 0);
  const auto tilted = shim::vec3(0.6, 0, 0.8), between = shim::vec3(0, 0.6, 0.8);
  for (const int p : {1, 2, 3, 7, 24, 255, 1024}) {
    const auto two = shim::powers_whole(
        shim::vec2(shim::strand_mirror(shim::angle_with(tilted, between), shim::angle_with(tilted, z)), 0.25),
        p);
    EXPECT_NEAR(two.x / std::pow(0.64 * 0.8 + std::sqrt(1 - 0.64 * 0.64) * 0.6, p), 1, 1e-12 * p) << p;
    EXPECT_EQ(two.y, std::ldexp(1, -2 * p)) << p;
  }
  EXPECT_EQ(shim::wrapped_light(-1, 0), 1);  // wrap = 0: the factor is always 1, as in the papers
  EXPECT_EQ(shim::surface_diffuse(-1, 0), 0);
  EXPECT_EQ(shim::surface_diffuse(.25, 0), .25);
  EXPECT_EQ(shim::shadow_factor(1, 1.5), 1);
  EXPECT_EQ(shim::shadow_factor(0, 1), 0);
  EXPECT_EQ(shim::wet_exponent(0, 0), 1);  // wet_specular = 0: no effect
  EXPECT_EQ(shim::wet_exponent(0, .5), .5);
  EXPECT_EQ(shim::wet_exponent(1, .5), 1);
  EXPECT_EQ(shim::occlusion_factor(.3, 0), 1);
  EXPECT_EQ(shim::occlusion_factor(0, .75), .25);
  EXPECT_EQ(shim::wet_factor(.3, 0), 1);
  EXPECT_EQ(shim::wet_factor(0, .5), 1);
  EXPECT_EQ(shim::wet_factor(1, .5), .5);
}

TEST(Equations, SubStepsShiftLikeTheReferences) {
  for (std::uint32_t trial = 0; trial < 2000; ++trial) {
    Any any{trial};
    const glm::dvec3 step = 0.1 * any.direction(), normal = any.direction(), eye = any.direction();
    const glm::dvec3 t = any.direction(), b = trial % 7 ? any.direction() : 2.0 * t;
    const glm::dvec3 shift = to_glm(shim::root_shift(in_shim(step), in_shim(normal), in_shim(eye)));
    expect_within(shift, reference::root_shift(step, normal, eye));
    const shim::real2 uv = shim::shift_in_uv(in_shim(shift), in_shim(t), in_shim(b));
    const glm::dvec2 expected = reference::uv_shares(shift, t, b);
    EXPECT_NEAR(uv.x, expected.x, 1e-9 * (1 + std::abs(expected.x)));
    EXPECT_NEAR(uv.y, expected.y, 1e-9 * (1 + std::abs(expected.y)));
  }
}

TEST(Equations, TheWetTangentIsTheReferences) {
  Scene scene;
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    Any any{trial};
    const glm::dvec3 rise = any.vector(), t = any.vector(), b = any.vector();
    const glm::dvec2 drift(any(), any());
    scene.shading.tangent = trial % 2 ? "paper" : "drawn";
    const double sign = trial % 2 ? 1 : -1;
    reference::Displacement clump;
    clump.delta_d = drift;
    expect_within(to_glm(shim::wet_tangent(shim::vec2(sign * drift.x, sign * drift.y), in_shim(t), in_shim(b),
                                           in_shim(rise))),
                  reference::wet_tangent(scene, rise, t, b, any.direction(), clump));
  }
  expect_within(to_glm(shim::wet_tangent(shim::vec2(0, 0), shim::vec3(4, 0, 0), shim::vec3(0, 2, 0),
                                         shim::vec3(0, 0, .3))),
                {0, 0, 1});
}

}  // namespace
}  // namespace pelage
