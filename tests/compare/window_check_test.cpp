// Tests check_against_reference(), which compares the whole picture if windows of 16 x 16 pixels differ too
// much from the reference.
#include <gtest/gtest.h>

#include "harness/compare/checks.hpp"
#include "harness/compare/metrics.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/scene/scene.hpp"
#include "harness/shells/reference/reference.hpp"

namespace pelage {
namespace {

constexpr std::uint32_t seed = 7;

struct Case {
  std::shared_ptr<const FrameInput> input;
  Picture picture;  // drawn by the reference
  Window first;     // the first of the windows that `seed` selects
};

// Returns a frame and its reference picture. The fur in this frame covers more pixels than 64 windows can
// contain.
const Case& torus() {
  static const Case made = [] {
    Scene scene;
    scene.model = "torus";
    scene.fur.layers = 2;
    scene.image.width = 800;
    scene.image.height = 600;
    Case c;
    c.input = prepare(scene, load_model(scene.model));
    c.picture = reference::render(*c.input, {});
    c.first = fur_windows(c.picture, 64, 16, seed).front();
    return c;
  }();
  return made;
}

// Returns the reference's picture after adding `by` to the colours of `count` pixels of the first window.
Picture spoilt(int count, float by) {
  Picture p = torus().picture;
  for (int i = 0; i < count; ++i) {
    glm::vec4& pixel =
        p.pixel[std::size_t(torus().first.y) * std::size_t(p.width) + std::size_t(torus().first.x + i)];
    pixel += glm::vec4(by, by, by, 0);
    pixel.w = 1;
  }
  return p;
}

std::string names_of(const WindowCheck& check) {
  std::string names;
  for (const Check& c : check.checks) names += c.metric + "; ";
  return names;
}

bool passes(const WindowCheck& check) {
  for (const Check& c : check.checks)
    if (!c.holds()) return false;
  return true;
}

TEST(WindowCheck, ThePictureDecidesAboutOneWrongPixel) {
  const WindowCheck check = check_against_reference(*torus().input, 0, spoilt(1, 0.25f), seed);
  EXPECT_LT(check.sample.psnr, tolerance::picture_psnr);
  EXPECT_EQ(check.sample.flips, 1u);
  EXPECT_EQ(check.agreement.flips, 1u);
  EXPECT_GT(check.sample.psnr_without_flips, check.sample.psnr + 40);
  EXPECT_GT(check.agreement.pixels, 2 * check.sample.pixels);
  EXPECT_GE(check.agreement.psnr, tolerance::picture_psnr);
  EXPECT_TRUE(passes(check));
}

TEST(WindowCheck, ManyWrongPixelsFail) {
  const WindowCheck check = check_against_reference(*torus().input, 0, spoilt(16, 0.25f), seed);
  EXPECT_LT(check.agreement.psnr, tolerance::picture_psnr);
  EXPECT_FALSE(passes(check));
}

TEST(WindowCheck, GoodWindowsAreEnough) {
  const WindowCheck check = check_against_reference(*torus().input, 0, torus().picture, seed);
  EXPECT_EQ(check.agreement.pixels, check.sample.pixels);
  EXPECT_EQ(names_of(check), "windows; fur pixels; psnr; p99.9; flips; ");
  EXPECT_TRUE(passes(check));
}

}  // namespace
}  // namespace pelage
