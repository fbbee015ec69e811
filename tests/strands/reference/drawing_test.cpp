// Tests properties of the reference for pictures of strands that follow from docs/strands.md, section
// Drawing.
#include "harness/strands/reference/drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/prepare/prepare.hpp"
#include "tests/strands/support/ball.hpp"

namespace pelage::strands::reference {
namespace {

constexpr int side = 200;       // pixels
constexpr float distance = 10;  // from the eye to the plane z = 0, R

/// A camera on the z axis, whose picture shows `side` pixels of the plane z = 0. Its field of view is small,
/// so that points near this plane have nearly the same scale.
Camera camera() {
  CameraScene scene;
  scene.framed = false;
  scene.eye = {0, 0, distance};
  scene.target = {0, 0, 0};
  scene.fov = 11.4f;
  ImageScene image;
  image.width = image.height = side;
  return make_camera(scene, image, {}, 0);
}

/// Length in R of `pixels` pixels in the plane z = 0.
float pixels(double count) {
  return float(count * double(camera().pixel) * double(distance));
}

/// A point of the plane z = 0; x and y are pixels from the image centre, y downwards.
glm::vec3 point(double x, double y, float z = 0) {
  return {pixels(x), -pixels(y), z};
}

DrawnStrand strand_of(glm::vec3 root, glm::vec3 joint, glm::vec3 tip, double width) {
  DrawnStrand s;
  s.point = {root, joint, tip};
  s.normal = {0, 0, 1};
  s.width = pixels(width);
  return s;
}

/// A look without taper, highlight and background.
Look plain(float opacity) {
  Look look;
  look.taper = 0;
  look.opacity = opacity;
  look.specular = glm::vec3(0);
  look.background = glm::vec3(0);
  return look;
}

Picture drawn(const Look& look, const std::vector<DrawnStrand>& strands) {
  return draw(camera(), look, strands, drawing_order(camera(), depth_range(camera(), 2), strands));
}

// The sum of all coverages is the area of the strip, in the mean over its position relative to the pixels. At
// one position, a strip with a slope of 2 differs by 9%, because the distances of its pixels have few values.
// The mean of 1 - t^3 over its six segments is the trapezoidal sum. The limit is 2%: the area has an error of
// at most half a pixel at each end of 60 pixels of length.
TEST(DrawingReference, CoverageAddsToTheAreaOfTheStrand) {
  constexpr int shifts = 8;
  double mean = 0;
  for (int k = 0; k < 6; ++k) mean += (2 - std::pow(k / 6.0, 3) - std::pow((k + 1) / 6.0, 3)) / 12;
  for (const double width : {0.25, 1.0, 3.0}) {
    for (int degrees = 0; degrees < 90; degrees += 7) {
      const double angle = (degrees + 0.5) * std::numbers::pi / 180;
      const double x = 30 * std::cos(angle), y = 30 * std::sin(angle);
      double area = 0;
      for (int k = 0; k < shifts; ++k) {
        const double right = 0.3 + double(k) / shifts, down = 0.7 * k;
        area += covered(drawn(plain(1), {strand_of(point(right - x, down - y), point(right, down),
                                                   point(right + x, down + y), width)})) /
                shifts;
      }
      EXPECT_NEAR(area / (60 * width * mean), 1, 0.02) << width << ", " << degrees;
    }
  }
}

TEST(DrawingReference, HalfTheWidthHasHalfTheCoverage) {
  const auto area = [](double width) {
    return covered(drawn(plain(1), {strand_of(point(-40, -13), point(3, 25), point(44, -7), width)}));
  };
  EXPECT_NEAR(area(0.2) / area(0.4), 0.5, 0.01);
  EXPECT_NEAR(area(0.4) / area(0.8), 0.5, 0.01);
}

// The strip of a bent strand has no gaps, and no pixel of it is blended twice. Along the curve, alpha is that
// of one fragment with full coverage.
TEST(DrawingReference, AJointIsBlendedOnce) {
  const std::array<glm::dvec2, 3> p{glm::dvec2(-50, 20), {10, -60}, {50, 30}};
  const DrawnStrand s = strand_of(point(p[0].x, p[0].y), point(p[1].x, p[1].y), point(p[2].x, p[2].y), 6);
  for (const int segments : {2, 3, 6, 8}) {
    Look look = plain(0.5f);
    look.segments = segments;
    const Picture picture = drawn(look, {s});
    for (const glm::vec4& pixel : picture.pixel) EXPECT_LE(pixel.a, 0.5f + 1e-6f);
    for (int k = 0; k < segments; ++k) {
      for (double u = 0.02; u < 1; u += 0.02) {
        const auto at = [&](int vertex) {
          const double t = double(vertex) / segments;
          return (1 - t) * (1 - t) * p[0] + 2 * t * (1 - t) * p[1] + t * t * p[2];
        };
        const glm::dvec2 place = (1 - u) * at(k) + u * at(k + 1) + 0.5 * side;
        const double first = std::pow(double(k) / segments, 3), last = std::pow(double(k + 1) / segments, 3);
        // Within a pixel, alpha changes by at most 0.5 times the largest slope of t^3 per pixel of this
        // curve, 3 / 100.
        EXPECT_NEAR(double(picture.at(int(place.x), int(place.y)).a), 0.5 * (1 - (1 - u) * first - u * last),
                    0.03)
            << segments << " segments, " << k + u;
      }
    }
  }
}

TEST(DrawingReference, TheNearerStrandIsInFront) {
  DrawnStrand red = strand_of(point(-30, 0, 0.1f), point(0, 0, 0.1f), point(30, 0, 0.1f), 8);
  DrawnStrand blue = strand_of(point(0, -30, -0.1f), point(0, 0, -0.1f), point(0, 30, -0.1f), 8);
  red.colour = {1, 0, 0};
  blue.colour = {0, 0, 1};
  Look look = plain(0.75f);
  look.ambient = 1;
  look.intensity = 0;
  const auto centre = [&](const DrawnStrand& a, const DrawnStrand& b) {
    return drawn(look, {a, b}).at(side / 2, side / 2);
  };
  const double a = 0.75 * (1 - 0.125);  // alpha in the middle of a strand
  const glm::vec4 pixel = centre(blue, red);
  EXPECT_NEAR(pixel.r, a, 0.01);
  EXPECT_NEAR(pixel.b, a * (1 - a), 0.01);
  EXPECT_EQ(centre(red, blue), pixel);  // the order in the list of strands has no influence
  red.rank = 1;
  EXPECT_NEAR(centre(blue, red).b, a, 0.01);
}

TEST(DrawingReference, ListHasFacingStrandsFromFrontToBack) {
  const auto upright = [](float z, glm::vec3 normal, int rank = 0) {
    DrawnStrand s = strand_of(point(0, 0, z), point(0, 0, z + 0.01f), point(0, 0, z + 0.02f), 1);
    s.normal = normal;
    s.rank = rank;
    return s;
  };
  const float edge = std::sqrt(1 - 0.25f * 0.25f);
  const std::vector<DrawnStrand> strands = {
      upright(0.5f, {0, 0, 1}),  upright(0.9f, {0, 0, -1}),          upright(0.9f, {0, 0, 1}, 3),
      upright(0.5f, {0, 1, 0}),  upright(0.7f, {edge, 0, -0.2499f}), upright(0.7f, {edge, 0, -0.2501f}),
      upright(-0.9f, {0, 0, 1}), upright(distance + 1, {0, 0, -1}),  upright(0.9f, {0, 0, 1}, 1)};
  std::vector<std::uint32_t> order;
  std::uint32_t last = 0;
  for (const Entry& entry : drawing_order(camera(), depth_range(camera(), 2), strands)) {
    EXPECT_GE(entry.key, last);
    last = entry.key;
    order.push_back(entry.strand);
  }
  EXPECT_EQ(order, (std::vector<std::uint32_t>{4, 0, 3, 6, 8, 2}));
}

// The root is in front of the near plane and the tip behind it, or the other way round.
TEST(DrawingReference, AStrandIsCutAtTheNearPlane) {
  const float behind = distance + 0.5f, front = distance - 0.5f;
  const auto at = [](float x, float z) { return glm::vec3(x, 0.001f, z); };
  for (const auto& [root, tip] : {std::pair{front, behind}, std::pair{behind, front}}) {
    DrawnStrand s = strand_of(at(0.01f, root), at(0, distance), at(-0.01f, tip), 1);
    s.normal = {0, 0, root > tip ? -1.0f : 1.0f};
    const Picture picture = drawn(plain(1), {s});
    EXPECT_GT(covered(picture), 1);
    for (const glm::vec4& pixel : picture.pixel)
      EXPECT_TRUE(std::isfinite(pixel.r) && std::isfinite(pixel.a));
  }
  DrawnStrand none = strand_of(at(0, behind), at(0, behind), at(0.1f, behind), 1);
  EXPECT_TRUE(drawing_order(camera(), depth_range(camera(), 2), {none}).empty());
}

TEST(DrawingReference, LightIsThatOfKajiyaAndKay) {
  const DrawnStrand s = strand_of(point(-50, 0), point(0, 0), point(50, 0), 6);
  const auto colour = [&](glm::vec3 light, float exponent, float specular) {
    Look look = plain(1);
    look.ambient = 0.25f;
    look.light = light;
    look.exponent = exponent;
    look.specular = glm::vec3(specular);
    const glm::vec4 pixel = drawn(look, {s}).at(side / 2 - 25, side / 2);
    return double(pixel.r) / double(pixel.a);
  };
  const double t = std::cos(std::numbers::pi / 6), u = std::sin(std::numbers::pi / 6);
  EXPECT_NEAR(colour({1, 0, 0}, 1, 0), 0.5 * 0.25, 1e-6);        // along the strand: no diffuse light
  EXPECT_NEAR(colour({0, 3, 0}, 1, 0), 0.5 * (0.25 + 1), 1e-6);  // across it, for every length of the vector
  EXPECT_NEAR(colour({float(t), float(u), 0}, 1, 0), 0.5 * (0.25 + u), 1e-6);
  // The strand is orthogonal to the view, so the highlight is sin(T, L)^p.
  EXPECT_NEAR(colour({float(t), float(u), 0}, 3, 1), 0.5 * (0.25 + u) + u * u * u, 1e-4);
}

TEST(DrawingReference, ADifferentTaperAndLengthOfSegmentsChangeTheArea) {
  const DrawnStrand s = strand_of(point(-40, 0.2), point(0, 0.2), point(40, 0.2), 4);
  Look look = plain(1);
  const double full = covered(drawn(look, {s}));
  look.taper = 1;
  EXPECT_LT(covered(drawn(look, {s})), 0.7 * full);
}

TEST(Drawing, ImpossibleLooksAreRefused) {
  const auto refused = [](auto change) {
    Look look;
    change(look);
    EXPECT_THROW(check(look), InputError);
  };
  EXPECT_NO_THROW(check(Look{}));
  refused([](Look& l) { l.segments = 0; });
  refused([](Look& l) { l.segments = 9; });
  refused([](Look& l) { l.taper = 1.1f; });
  refused([](Look& l) { l.opacity = std::numeric_limits<float>::quiet_NaN(); });
  refused([](Look& l) { l.light = glm::vec3(0); });
  refused([](Look& l) { l.exponent = 0; });
  refused([](Look& l) { l.background.g = -0.1f; });
}

// The irradiance of a light that is projected to spherical harmonics, by integration over the sphere: the
// projected radiance times the clamped cosine. The sum over
// the sphere has an error of about 1e-6.
TEST(FillLights, AreTheIntegralOfTheProjectedRadiance) {
  Look look;
  look.fills = {{{0.3f, 0.8f, -0.5f}, {1, 0.5f, 0.2f}}, {{-1, 0.1f, 0.4f}, {0.3f, 0.6f, 0.9f}}};
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.5, 0.3, 0.7));
  for (const int bands : {1, 2}) {
    look.bands = bands;
    glm::dvec3 sum(0);
    constexpr int rings = 400, steps = 800;
    const double pi = std::numbers::pi;
    for (int i = 0; i < rings; ++i) {
      const double z = 1 - (2 * i + 1.0) / rings, r = std::sqrt(1 - z * z);
      for (int k = 0; k < steps; ++k) {
        const glm::dvec3 w(r * std::cos(2 * pi * k / steps), r * std::sin(2 * pi * k / steps), z);
        glm::dvec3 radiance(0);
        for (const FillLight& fill : look.fills) {
          // The addition theorem: the sum of Y_lm(a) Y_lm(b) over m is (2 l + 1) / (4 pi) P_l(a . b).
          const double x = glm::dot(w, glm::normalize(glm::dvec3(fill.direction)));
          const double second = bands == 2 ? 5 * (3 * x * x - 1) / 2 : 0;
          radiance += (1 + 3 * x + second) / (4 * pi) * glm::dvec3(fill.colour);
        }
        sum += std::max(0.0, glm::dot(n, w)) * radiance * (4 * pi / (rings * steps));
      }
    }
    const Irradiance sh = irradiance_of(look);
    const std::array<double, 9> basis = basis_at(n);
    glm::dvec3 found(0);
    for (std::size_t i = 0; i < 9; ++i) found += basis[i] * glm::dvec3(sh[i]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], sum[c], 1e-3) << bands << " bands, colour " << c;
  }
}

// A projected light differs from max(0, n . l) by at most 10% of the light, for every normal.
TEST(FillLights, ProjectionCostsAtMostATenth) {
  Look look;
  look.fills = {{{0, 0, 1}, glm::vec3(1)}};
  const Irradiance sh = irradiance_of(look);
  double worst = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double z = 1 - i / 500.0, r = std::sqrt(std::max(0.0, 1 - z * z));
    const std::array<double, 9> basis = basis_at({r * 0.6, r * 0.8, z});
    double found = 0;
    for (std::size_t k = 0; k < 9; ++k) found += basis[k] * double(sh[k].x);
    worst = std::max(worst, std::abs(std::max(0.0, found) - std::max(0.0, z)));
  }
  std::printf("a projected fill light differs by at most %.4f of the light\n", worst);
  EXPECT_LE(worst, tolerance::projected_fill);
  EXPECT_GT(worst, 0.05);  // a projection with infinitely many bands would have no error
}

}  // namespace
}  // namespace pelage::strands::reference
