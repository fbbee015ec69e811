// Tests the level of detail of pictures of strands (docs/strands.md, section "Level of detail").
#include "harness/strands/drawing/detail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "tests/strands/support/device_picture.hpp"
#include "tests/strands/support/strands.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::strands {
namespace {

Look look_of(float fraction) {
  Look look;
  look.fraction = fraction;
  return look;
}

DrawingScene view_of(float fraction, glm::vec3 eye = {0.5f, 0.6f, 3.4f}) {
  DrawingScene scene = ball_scene(160, 120, eye);
  scene.look.fraction = fraction;
  return scene;
}

Drawer drawer_of(const DrawingScene& scene, const Ball& ball) {
  return {test::queue(), scene, ball.strands, ball.keys.size()};
}

TEST(StrandDetail, TheWidthsOfThePrefixReplaceThoseOfAllStrands) {
  for (const float fraction : {1e-6f, 0.013f, 0.1f, 0.5f, 0.9f, 0.99f, 0.999f, 1.0f}) {
    constexpr std::size_t count = 10000;
    const Pruning pruning = pruning_of(count, look_of(fraction));
    EXPECT_EQ(pruning.drawn, std::max(1, int(std::ceil(double(fraction) * count))));
    double sum = 0;
    for (int i = 0; i < pruning.drawn; ++i)
      sum += double(pruning.widen) * std::min(double(pruning.drawn - i) * double(pruning.per_fade), 1.0);
    EXPECT_NEAR(sum, double(count), 2e-3) << fraction;
  }
  EXPECT_EQ(pruning_of(10000, look_of(1)).widen, 1.0f);
}

TEST(StrandDetail, NoWidthJumpsWhenTheFractionFalls) {
  // The factor of a strand changes by a small part of `widen` if the fraction changes by one strand.
  constexpr std::size_t count = 4000;
  const auto factor = [](const Pruning& p, int i) {
    return double(p.widen) * std::clamp(double(p.drawn - i) * double(p.per_fade), 0.0, 1.0);
  };
  for (int drawn = int(count) - 100; drawn > 400; drawn -= 7) {
    const Pruning now = pruning_of(count, look_of(float(drawn) / count)),
                  next = pruning_of(count, look_of(float(drawn - 1) / count));
    for (int i = 0; i < int(count); ++i)
      ASSERT_LT(std::abs(factor(now, i) - factor(next, i)), 0.06 * double(now.widen))
          << drawn << ", strand " << i;
  }
}

TEST(StrandDetail, APrunedPictureIsThatOfTheReference) {
  const Ball ball(3000, 2);
  for (const Drawing mapping : {Drawing::item, Drawing::group})
    for (const float fraction : {0.9f, 0.31f}) {
      DrawingScene scene = view_of(fraction);
      scene.look.width_factor = 0.8f;
      expect_reference_picture(scene, draw_on_device(scene, ball, {.mapping = mapping}));
    }
}

TEST(StrandDetail, AViewThatChangesGivesThePictureOfANewDrawer) {
  const Ball ball(3000);
  Drawer drawer = drawer_of(view_of(1), ball);
  for (const auto& [fraction, distance] :
       {std::pair(0.5f, 3.0f), std::pair(0.1f, 6.0f), std::pair(1.0f, 2.5f), std::pair(0.97f, 3.4f)}) {
    DrawingScene scene = view_of(fraction, {0.5f, 0.6f, distance});
    scene.look.segments = distance > 3 ? 4 : 6;
    drawer.set_view(scene);
    EXPECT_EQ(drawn_with(drawer, ball.keys).pixel, draw_on_device(scene, ball).picture.pixel) << fraction;
  }
}

TEST(StrandDetail, AViewMayChangeTheRanksOfTheLayers) {
  const Ball ball(1000, 2);
  DrawingScene scene = view_of(1);
  Drawer drawer = drawer_of(scene, ball);
  for (const auto& [first, second] : {std::pair(0, 1), std::pair(1, 0), std::pair(0, 0), std::pair(3, 2)}) {
    scene.look.layers = {{first, 0, 1}, {second, 0, 1}};
    drawer.set_view(scene);
    const DevicePicture fresh = draw_on_device(scene, ball);
    EXPECT_EQ(drawn_with(drawer, ball.keys).pixel, fresh.picture.pixel) << first << ", " << second;
    EXPECT_EQ(drawer.order(test::queue()), fresh.order) << first << ", " << second;
  }
}

TEST(StrandDetail, AViewWithOtherProgramsIsRefused) {
  Drawer drawer = drawer_of(view_of(1), Ball(50));
  DrawingScene other = view_of(1);
  other.camera.width = 161;
  EXPECT_THROW(drawer.set_view(other), InputError);
  other = view_of(1);
  other.look.rim = {1, 1, 1};
  EXPECT_THROW(drawer.set_view(other), InputError);
  other = view_of(1);
  other.look.film.resize(1);
  EXPECT_THROW(drawer.set_view(other), InputError);
  for (const float fraction : {0.0f, -1.0f, 1.5f, std::nanf("")}) {
    other = view_of(fraction);
    EXPECT_THROW(drawer.set_view(other), InputError);
  }
}

TEST(StrandDetail, CoverageIsKept) {
  // Roots are spread evenly over the sphere by a low-discrepancy sequence, so each prefix is spread evenly.
  Ball ball(20000);
  for (std::size_t i = 0; i < ball.strands.size(); ++i) {
    const double height = 2 * std::fmod(0.5 + 0.7548776662466927 * double(i), 1.0) - 1;
    const double angle = 2 * std::numbers::pi * std::fmod(0.5698402909980532 * double(i), 1.0);
    const double across = std::sqrt(1 - height * height);
    const glm::vec3 root(glm::dvec3(across * std::cos(angle), height, across * std::sin(angle)));
    for (std::size_t k = 0; k < 3; ++k) {
      KeyStrand& key = ball.keys[3 * i + k];
      key.root = key.normal = root;
      key.first = glm::normalize(root + glm::vec3(0.3f, 0.1f, -0.2f));
      key.second = glm::normalize(root + glm::vec3(0.6f, 0.1f, -0.2f));
    }
    ball.strands[i].length = 0.15f;
    ball.strands[i].width = 0.0002f;  // so thin that overlaps hardly change the coverage
  }
  Drawer drawer = drawer_of(view_of(1), ball);
  for (const auto& [fraction, distance] :
       {std::pair(0.5f, 5.0f), std::pair(0.25f, 7.0f), std::pair(0.1f, 12.0f)}) {
    drawer.set_view(view_of(1, {0, 0, distance}));
    const double all = covered(drawn_with(drawer, ball.keys));
    drawer.set_view(view_of(fraction, {0, 0, distance}));
    EXPECT_NEAR(covered(drawn_with(drawer, ball.keys)), all, 0.01 * all) << fraction;
  }
}

TEST(StrandDetail, FewerStrandsAreDrawnWhereTheyWouldBeThin) {
  const Spread spread{1000, 0.01f, 4.0f};
  const auto fraction = [&](float distance, float least) {
    return fraction_on_screen(view_of(1, {0, 0, distance}).camera, spread, least);
  };
  const double pixel = double(view_of(1, {0, 0, 5}).camera.pixel);
  EXPECT_EQ(fraction(50, 0), 1.0f);
  EXPECT_EQ(fraction(1e6f, 1), 0.001f);
  // At the distance 20 the strands are `pixels` wide.
  const auto pixels = float(0.01 / (20 * pixel));
  EXPECT_NEAR(fraction(20, pixels), 1, 1e-5);
  EXPECT_EQ(fraction(10, pixels), 1.0f);
  EXPECT_NEAR(fraction(40, pixels), 0.5, 1e-5);
  EXPECT_NEAR(fraction(200, pixels), 0.1, 1e-5);
}

TEST(StrandDetail, SegmentsFollowTheSizeOnTheScreen) {
  const DrawingScene scene = view_of(1);
  const auto segments = [&](float length, int most) {
    return segments_on_screen(scene.camera, scene.range, length, most);
  };
  EXPECT_EQ(segments(1e-6f, 7), 3);
  EXPECT_EQ(segments(1e6f, 7), 7);
  EXPECT_EQ(segments(1e6f, 5), 5);
  EXPECT_EQ(segments(1e6f, 2), 2);
  EXPECT_EQ(segments(1e-6f, 1), 1);
  // The middle of the chord from t = 0 to t = 1 / n, for a strand that is bent by 90 degrees.
  const double pixel = double(scene.camera.pixel) * double(scene.range.nearest);
  for (const double pixels : {14.0, 20.0, 30.0, 45.0, 60.0}) {
    const int n = segments(float(pixels * pixel), 7);
    const auto error = [&](int count) {
      const auto at = [&](double t) { return pixels / 2 * glm::dvec2(2 * t * (1 - t) + t * t, t * t); };
      const double step = 1.0 / count;
      return glm::length(at(step / 2) - 0.5 * (at(0) + at(step)));
    };
    EXPECT_LE(error(n), 0.25001) << pixels;
    if (n > 3) {
      EXPECT_GT(error(n - 1), 0.25) << pixels;
    }
  }
}

// Tests that pictures of a part of the strands have the coverage of pictures of all strands
// (docs/strands.md, section "Level of detail").
double coverage_of(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) {
  Strands strands(test::queue().device(), prepare_strands(scene, mesh));
  strands.still();
  return covered(strands.read());
}

TEST(StrandCoverage, IsKeptIfStrandsAreLeftOut) {
  const auto mesh = std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 96, 48));
  Scene scene;
  scene.strands.skin = false;
  scene.strands.shadow = "none";
  scene.strands.layers.front().count = 100000;
  for (const auto& [width, height] : {std::pair(320, 240), std::pair(80, 60)}) {
    scene.image.width = width;
    scene.image.height = height;
    scene.strands.fraction = 1;
    const double all = coverage_of(scene, mesh);
    for (const float fraction : {0.5f, 0.25f, 0.1f}) {
      scene.strands.fraction = fraction;
      EXPECT_NEAR(coverage_of(scene, mesh) / all, 1, tolerance::kept_coverage)
          << width << " pixels, " << fraction;
    }
  }
}

TEST(StrandCoverage, TheFactorOfTheWidthsIsThatOfTheDocument) {
  Camera camera;
  camera.row_w = {0, 0, -1, 4};
  camera.pixel = 0.002f;
  camera.near = 0.01f;
  Look look;
  look.taper = 0.4f;
  look.opacity = 0.7f;
  const Spread spread{50000, 0.003f, 9.0f};
  const auto missing = [&](double f) {
    const double w = 0.003 * (1 - 0.4 / 2) / f, d = std::sqrt(9.0 / (f * 50000)), p = 0.002 * 4;
    const double b = std::sqrt(w * w + 1.44 * p * p);
    return 0.55 * 0.7 * w / b * (1 - std::exp(-1.5 * b / d));
  };
  EXPECT_EQ(overlap_factor(camera, look, spread), 1.0f);
  double before = 1;
  for (const float f : {0.9f, 0.5f, 0.25f, 0.1f, 0.01f}) {
    look.fraction = f;
    const double q = double(overlap_factor(camera, look, spread));
    EXPECT_NEAR(q, (1 + missing(1)) / (1 + missing(double(f))), 1e-6) << f;
    EXPECT_LT(q, before);
    before = q;
  }
}

}  // namespace
}  // namespace pelage::strands
