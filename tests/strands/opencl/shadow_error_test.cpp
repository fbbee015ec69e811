// Compares the reading "exp" of the opacity map with the transmittance towards the light of dense fur
// (docs/strands.md, section Shadow), in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/compare/dense_fur.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/strands/drawing/light_view.hpp"

namespace pelage::strands {
namespace {

TEST(StrandShadowError, OfTheReadingExpIsSmallInDenseFur) {
  Scene scene;
  scene.model = "bunny";
  const auto mesh = load_scene_mesh(scene, [](const std::string&) {});
  for (const DenseLook& dense : dense_looks) {
    const DenseFur fur = dense_fur(*mesh, dense, 256);
    const reference::LightColumns columns =
        reference::light_columns(fur.look, light_view(fur.look), fur.strands);
    const reference::OpacityMap map = reference::opacity_map(columns);
    const std::vector<LightSample> samples = light_samples(columns);
    double error = 0, optical_depth = 0;
    for (const LightSample& s : samples) {
      error += std::abs(reference::texel_light(fur.look, map[s.texel], s.depth) - s.through);
      optical_depth += -std::log(std::max(map[s.texel].through, 1e-12));
    }
    EXPECT_GT(optical_depth / double(samples.size()), 3);
    EXPECT_LT(error / double(samples.size()), tolerance::shadow_error) << dense.name;
  }
}

}  // namespace
}  // namespace pelage::strands
