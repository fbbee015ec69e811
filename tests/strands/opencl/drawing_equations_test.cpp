// Compiles the kernels' functions for pictures of strands as C++ in double precision, and compares their
// results with the reference and with the formulas of docs/strands.md, section Drawing.
#define STRAND_SHADOW 2  // the kernels read the opacity map as SHADOW_EXPONENTIAL
#define STRAND_LAYERS 1  // fur layers have looks of their own
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/strands/reference/drawing.hpp"
#include "kernels/strands/draw/params.h"
#include "tests/strands/support/ball.hpp"
#include "tests/support/opencl_as_cpp.hpp"

namespace pelage::in_double {
// clang-format off
#include "strands/draw/strip.clh"
// clang-format on
}  // namespace pelage::in_double

namespace pelage::strands {
namespace {

namespace shim = in_double;

shim::real3 shim_of(glm::dvec3 v) {
  return shim::vec3(v.x, v.y, v.z);
}
glm::dvec3 glm_of(const shim::real3& v) {
  return {v.x, v.y, v.z};
}

shim::Key shim_of(const KeyStrand& key) {
  return {shim_of(glm::dvec3(key.root)), shim_of(glm::dvec3(key.normal)), shim_of(glm::dvec3(key.first)),
          shim_of(glm::dvec3(key.second)), shim_of(glm::dvec3(key.rest))};
}
shim::Turn turn_of(float degrees) {
  const double angle = double(degrees) * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

TEST(StrandEquations, StrandsBetweenKeysAreThoseOfTheReference) {
  Ball ball(300);
  constexpr float first = 0.45f;
  for (std::size_t i = 0; i < ball.strands.size(); ++i) {
    KeyedStrand& s = ball.strands[i];
    s.response = 0.2f + 0.01f * float(i % 150);
    s.twist = 7 * float(i % 50) - 170;
    s.curvature = 5 * float(i % 40) - 100;
    shim::Key key = shim::between_keys(shim_of(ball.keys[s.key[0]]), shim_of(ball.keys[s.key[1]]),
                                       shim_of(ball.keys[s.key[2]]), s.weight.x, s.weight.y);
    key = shim::above_skin(shim::styled(key, s.response, turn_of(s.twist), turn_of(s.curvature)),
                           double(1 - first) / double(first));
    const shim::Curve curve = shim::curve_of(key, s.length, first);
    const DrawnStrand expected = reference::between(ball.keys, s, first);
    const std::array<glm::dvec3, 3> point{glm_of(curve.root), glm_of(curve.joint), glm_of(curve.tip)};
    for (std::size_t k = 0; k < 3; ++k)  // the reference rounds its points to single precision
      EXPECT_LT(glm::distance(point[k], glm::dvec3(expected.point[k])), 3e-7) << i << ", point " << k;
  }
}

/// Parameters with arbitrary values for the light.
DrawParams params() {
  DrawParams p{};
  p.near_depth = 0.1f;
  p.pixel = 0.002f;
  p.segments = 6;
  p.taper = 0.8f;
  p.opacity = 0.9f;
  const glm::vec3 light = glm::normalize(glm::vec3(0.3f, -0.8f, 0.4f));
  for (int c = 0; c < 3; ++c) {
    p.light[c] = light[c];
    p.specular[c] = 0.1f * float(c + 1);
  }
  p.intensity = 1.3f;
  p.ambient = 0.2f;
  p.exponent = 7.5f;
  p.skin_shadow = 0.6f;
  // X and Y of the root of the strand below give column 1.25 and row 0.5 of a map of 4 x 4 texels.
  p.map_x[0] = 0.005f;
  p.map_x[3] = 1;
  p.map_y[1] = -0.002f;
  p.map_y[3] = 0.3f;
  p.map_z[2] = 0.5f;
  p.map_z[3] = -1.2f;
  p.map_size = 4;
  p.per_shadow_length = 2.5f;
  return p;
}

TEST(StrandEquations, AVertexHasTheValuesOfTheDocument) {
  const DrawParams p = params();
  constexpr float own_opacity = 0.7f, own_taper = 1.1f, own_gloss = 1.7f, own_exponent = 0.6f,
                  own_skin = 0.8f;
  const auto bits = [](float value) { return std::bit_cast<std::int32_t>(value); };
  const std::array<std::int32_t, 2 * std::size_t(FILM_RECORD)> film{0x10ff80,
                                                                    0x20e070,
                                                                    0x30c060,
                                                                    0x40a050,
                                                                    0x508040,
                                                                    0x606030,
                                                                    0x704020,
                                                                    0x802010,
                                                                    0,
                                                                    0,
                                                                    0,
                                                                    0,
                                                                    0,
                                                                    0xff8080,
                                                                    0xef7090,
                                                                    0xdf60a0,
                                                                    0xcf50b0,
                                                                    0xbf40c0,
                                                                    0xaf30d0,
                                                                    0x9f20e0,
                                                                    0x8f10f0,
                                                                    bits(own_opacity),
                                                                    bits(own_taper),
                                                                    bits(own_gloss),
                                                                    bits(own_exponent),
                                                                    bits(own_skin)};
  std::array<float, 64> map{};
  for (std::size_t i = 0; i < 16; ++i) {
    map[4 * i] = 0.1f * float(i % 3);              // least depth
    map[4 * i + 1] = 4 + float(i % 5);             // 1 / D
    map[4 * i + 2] = 0.9f - 0.05f * float(i % 7);  // transmittance
  }
  shim::Row r{};
  // X and Y are camera coordinates divided by `pixel`.
  const glm::dvec3 root(0.1, -0.2, 3), joint(0.15, -0.3, 2.9), tip(0.3, -0.35, 2.95);
  const glm::dvec3 scale(1 / double(p.pixel), 1 / double(p.pixel), 1);
  r.root = shim_of(root * scale);
  r.joint = shim_of(joint * scale);
  r.tip = shim_of(tip * scale);
  r.radius = 4;
  const glm::dvec3 colour(0.5, 0.4, 0.3), steady(0.11, 0.12, 0.13);
  r.colour = shim_of(colour);
  r.frame = 1;
  r.joint_height = 0.3;
  r.tip_height = 0.9;
  r.steady = shim_of(steady);
  const glm::dvec3 light(p.light[0], p.light[1], p.light[2]), from_eye = glm::normalize(joint);
  const auto sine = [](glm::dvec3 a, glm::dvec3 b) { return glm::length(glm::cross(a, b)); };
  for (int k = 0; k <= 6; ++k) {
    const double t = k / 6.0;
    const shim::Vertex v = shim::vertex_at(&p, film.data(), map.data(), r, shim::towards_joint(&p, r), t);
    const glm::dvec3 at = (1 - t) * (1 - t) * root + 2 * t * (1 - t) * joint + t * t * tip;
    EXPECT_NEAR(v.x, at.x / at.z / double(p.pixel), 1e-9);
    EXPECT_NEAR(v.y, at.y / at.z / double(p.pixel), 1e-9);
    EXPECT_NEAR(v.radius, 4 * (1 - double(p.taper) * double(own_taper) * t) / at.z, 1e-9);
    const double place = 7 * t;
    const auto first = std::size_t(std::min(std::floor(place), 6.0));
    const auto factor = [&](int byte) {
      const auto value = [&](std::size_t i) { return double(film[FILM_RECORD + i] >> (8 * byte) & 255); };
      return value(first) + (place - double(first)) * (value(first + 1) - value(first));
    };
    EXPECT_NEAR(v.alpha, double(p.opacity) * double(own_opacity) * factor(2) / 255 * (1 - t * t * t), 1e-7);
    const glm::dvec3 tangent = glm::normalize((1 - t) * (joint - root) + t * (tip - joint));
    const double mirror = std::max(0.0, glm::dot(tangent, light) * glm::dot(tangent, from_eye) +
                                            sine(tangent, light) * sine(tangent, from_eye));
    const double height = std::min(1.0, std::max(0.0, 2 * t * (1 - t) * 0.3 + t * t * 0.9));
    const double shadow = 1 - double(p.skin_shadow) * double(own_skin) * (1 - height);
    const double shadow_depth = double(p.map_z[2]) * at.z + double(p.map_z[3]);
    const double x = double(p.map_x[0]) * at.x / double(p.pixel) + double(p.map_x[3]);
    const double y = double(p.map_y[1]) * at.y / double(p.pixel) + double(p.map_y[3]);
    double key = 0;  // sum over the four texels around the vertex
    for (int corner = 0; corner < 4; ++corner) {
      const int right = corner % 2, below = corner / 2;
      const double left = std::floor(x), top = std::floor(y);
      const auto texel = (std::size_t(top) + std::size_t(below)) * 4 + std::size_t(left) + std::size_t(right);
      const double weight = (right ? x - left : 1 - x + left) * (below ? y - top : 1 - y + top);
      const double s =
          std::clamp((shadow_depth - double(map[4 * texel])) * double(map[4 * texel + 1]), 0.0, 1.0);
      key += weight * std::pow(double(map[4 * texel + 2]), s);
    }
    for (int c = 0; c < 3; ++c) {
      const double lit = steady[c] + key * double(p.intensity) *
                                         (colour[c] * sine(tangent, light) +
                                          double(own_gloss) * factor(1) / 128 * double(p.specular[c]) *
                                              std::pow(mirror, double(p.exponent) * double(own_exponent)));
      EXPECT_NEAR(glm_of(v.colour)[c], shadow * factor(0) / 128 * lit, 1e-6) << k << ", colour " << c;
    }
  }
}

TEST(StrandEquations, ACurveIsCutWhereItCrossesTheNearPlane) {
  const DrawParams p = params();
  shim::Row r{};
  r.root = shim::vec3(0, 0, 0.2);
  r.joint = shim::vec3(0, 0, 0.15);
  r.tip = shim::vec3(0, 0, 0.02);
  shim::Part part = shim::visible_part(&p, r, p.segments);
  EXPECT_EQ(part.from, 0);
  EXPECT_NEAR(shim::bezier1(0.2, 0.15, 0.02, part.to), double(p.near_depth), 1e-8);
  std::swap(r.root, r.tip);
  part = shim::visible_part(&p, r, p.segments);
  EXPECT_EQ(part.to, 1);
  EXPECT_NEAR(shim::bezier1(0.02, 0.15, 0.2, part.from), double(p.near_depth), 1e-8);
  r.tip.z = 0.05;
  EXPECT_FALSE(shim::visible_part(&p, r, p.segments).drawn);
}

// The polygon of the strip is at most 1/4 pixel from the curve; with one segment less, it is not, if the
// strand needs more than three and fewer than all. The curves are parallel to the picture.
TEST(StrandEquations, AStrandHasAsManySegmentsAsItNeeds) {
  DrawParams p = params();
  p.own_segments = 1;
  p.segments = 7;
  constexpr double depth = 2.5;
  const auto furthest = [&](int n, double bend) {
    double most =
        0;  // between the curve and its chords, where the parameter of the chord is that of the curve
    for (int i = 0; i < 4200; ++i) {
      const double t = i / 4200.0, first = std::floor(t * n) / n, last = first + 1.0 / n;
      const auto height = [&](double s) { return 2 * s * (1 - s) * bend / 2; };
      const double chord = height(first) + (t - first) * n * (height(last) - height(first));
      most = std::max(most, std::abs(height(t) - chord));
    }
    return most;
  };
  int seen = 0;
  for (double bend = 0.1; bend < 90; bend *= 1.13) {  // |P0 - 2 P1 + P2|, pixels
    shim::Row r{};
    r.root = shim::vec3(0, 0, depth);
    r.joint = shim::vec3(30 * depth, bend / 2 * depth, depth);
    r.tip = shim::vec3(60 * depth, 0, depth);
    const int n = shim::segments_of_strip(&p, r);
    EXPECT_GE(n, 3);
    EXPECT_LE(n, 7);
    if (n < 7) {
      EXPECT_LE(furthest(n, bend), 0.25 + 1e-6) << bend;
    }
    if (n > 3) {
      EXPECT_GT(furthest(n - 1, bend), 0.25 - 1e-6) << bend;
    }
    seen |= 1 << n;
  }
  EXPECT_EQ(seen, 0b11111000);
  shim::Row near{};
  near.root = near.joint = shim::vec3(0, 0, 0.5);
  near.tip = shim::vec3(0, 0, 0.05);
  EXPECT_EQ(shim::segments_of_strip(&p, near), 7) << "the near plane cuts the strand";
  p.own_segments = 0;
  p.segments = 5;
  EXPECT_EQ(shim::segments_of_strip(&p, near), 5);
}

}  // namespace
}  // namespace pelage::strands
