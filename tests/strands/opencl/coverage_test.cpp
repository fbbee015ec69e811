// Tests that pictures of a part of the strands have the coverage of pictures of all strands
// (docs/strands.md, section "Level of detail").
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "harness/compare/tolerances.hpp"
#include "harness/strands/drawing/detail.hpp"
#include "harness/strands/opencl/strands.hpp"
#include "tests/strands/support/strands.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage::strands {
namespace {

double coverage_of(const Scene& scene, const std::shared_ptr<const Mesh>& mesh) {
  Strands strands(test::queue().device(), prepare_strands(scene, mesh));
  strands.still();
  return test::mean_coverage(strands.read());
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
