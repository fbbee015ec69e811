// Tests the level of detail of pictures of strands (docs/strands.md, section "Level of detail").
#include "harness/strands/drawing/detail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "harness/compare/metrics.hpp"
#include "harness/error.hpp"
#include "harness/strands/opencl/drawer.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "tests/strands/support/ball.hpp"
#include "tests/strands/support/strands.hpp"

namespace pelage::strands {
namespace {

Look look_of(float fraction) {
  Look look;
  look.fraction = fraction;
  return look;
}

DrawingScene view_of(float fraction, glm::vec3 eye = {0.5f, 0.6f, 3.4f}) {
  DrawingScene scene;
  scene.camera = camera_at(160, 120, eye);
  scene.range = depth_range(scene.camera, 1 + longest);
  scene.first_segment = 0.45f;
  scene.look.fraction = fraction;
  return scene;
}

Drawer drawer_of(const DrawingScene& scene, const Ball& ball, const DrawerOptions& options = {}) {
  Drawer drawer(test::queue(), scene, ball.strands, ball.keys.size(), options);
  const std::vector<float> records = key_records(ball.keys);
  drawer.keys().write(test::queue(), records);
  return drawer;
}

Picture picture_of(Drawer& drawer) {
  drawer.enqueue(test::queue(), nullptr);
  return drawer.read(test::queue());
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
      DrawerOptions options;
      options.mapping = mapping;
      DrawingScene scene = view_of(fraction);
      scene.look.width_factor = 0.8f;
      Drawer drawer = drawer_of(scene, ball, options);
      const std::vector<DrawnStrand> strands = reference::pruned(drawer.curves(test::queue()), scene.look);
      const Picture picture = picture_of(drawer);
      const std::vector<Entry> order = reference::drawing_order(scene.camera, scene.range, strands);
      EXPECT_EQ(drawer.order(test::queue()), order);
      const Agreement found = compare(picture, reference::draw(scene.camera, scene.look, strands, order));
      EXPECT_TRUE(within(found)) << found.psnr << " dB";
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
    Drawer fresh = drawer_of(scene, ball);
    EXPECT_EQ(picture_of(drawer).pixel, picture_of(fresh).pixel) << fraction;
  }
}

TEST(StrandDetail, AViewMayChangeTheRanksOfTheLayers) {
  const Ball ball(1000, 2);
  DrawingScene scene = view_of(1);
  Drawer drawer = drawer_of(scene, ball);
  for (const auto& [first, second] : {std::pair(0, 1), std::pair(1, 0), std::pair(0, 0), std::pair(3, 2)}) {
    scene.look.layers = {{first, 0, 1}, {second, 0, 1}};
    drawer.set_view(scene);
    Drawer fresh = drawer_of(scene, ball);
    EXPECT_EQ(picture_of(drawer).pixel, picture_of(fresh).pixel) << first << ", " << second;
    EXPECT_EQ(drawer.order(test::queue()), fresh.order(test::queue())) << first << ", " << second;
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
    const double all = test::mean_coverage(picture_of(drawer));
    drawer.set_view(view_of(fraction, {0, 0, distance}));
    EXPECT_NEAR(test::mean_coverage(picture_of(drawer)), all, 0.01 * all) << fraction;
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

}  // namespace
}  // namespace pelage::strands
