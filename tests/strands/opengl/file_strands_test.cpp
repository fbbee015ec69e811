// Pictures of strands of a file by OpenGL against the double-precision reference.
#include "tests/strands/support/file_strands.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "harness/compare/strands.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/strands/opengl/ribbons.hpp"

namespace pelage::strands {
namespace {

struct RibbonsOfFile : pelage::test::FileStrands {};

/// Returns the strands that nowhere turn by more than 60 degrees in the picture. Where a strand folds back on
/// itself, a triangle strip has other pixels than segments that are drawn one by one.
Polylines without_folds(const Polylines& lines, const Camera& camera) {
  const auto place = [&](glm::vec3 point) {
    const glm::vec4 p(point, 1);
    return glm::vec2(glm::dot(camera.row_x, p), glm::dot(camera.row_y, p)) / glm::dot(camera.row_w, p);
  };
  Polylines kept;
  std::size_t first = 0;
  for (std::size_t i = 0; i < lines.count.size(); first += lines.count[i++]) {
    const std::size_t last = first + lines.count[i];
    bool folds = false;
    for (std::size_t k = first + 2; k < last; ++k) {
      const glm::vec2 at = place(lines.point[k - 1]), before = at - place(lines.point[k - 2]),
                      behind = place(lines.point[k]) - at;
      folds |= !(glm::dot(before, behind) > 0.5f * glm::length(before) * glm::length(behind));
    }
    if (folds) continue;
    kept.count.push_back(lines.count[i]);
    for (std::size_t k = first; k < last; ++k) {
      kept.point.push_back(lines.point[k]);
      kept.width.push_back(lines.width[k]);
      kept.colour.push_back(lines.colour[k]);
    }
  }
  return kept;
}

TEST_F(RibbonsOfFile, LookTheSameInOpenGl) {
  scene.image.width = 1280;
  scene.image.height = 960;
  write(without_folds(pelage::test::curly(*torus, 1500), input()->camera));
  for (const char* expand : {"instanced", "indexed"}) {
    for (const char* shadow : {"none", "linear"}) {
      scene.strands.shadow = shadow;
      scene.strands.skin = expand[2] == 's';
      const auto in = input();
      EXPECT_GT(in->fur.keys.size(), 300u);
      Ribbons ribbons(*in, in->fur.strands, {.expand = expand});
      ribbons.frame(in->fur.keys);
      const double psnr =
          compare(ribbons.read(), reference_strands(*in, in->fur.keys, in->skin).picture).psnr;
      EXPECT_GE(psnr, tolerance::other_filter_psnr) << expand << ", " << shadow;
    }
  }
}

}  // namespace
}  // namespace pelage::strands
