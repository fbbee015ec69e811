// Compares the reading "exp" of the opacity map with the transmittance towards the light of dense fur
// (docs/strands.md, section Shadow), in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/compare/tolerances.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/strands/drawing/light_view.hpp"
#include "harness/strands/groom/fur.hpp"
#include "harness/strands/reference/keyed.hpp"
#include "harness/strands/reference/opacity_map.hpp"

namespace pelage::strands {
namespace {

struct Fragments {
  double mean_error = 0;     ///< mean absolute difference of the light
  double optical_depth = 0;  ///< mean over the fragments
};

struct Case {
  int strands;
  float length, width, lean;
};

Fragments compared(const Mesh& mesh, const Case& c) {
  StrandsScene scene;
  StrandLayerScene& layer = scene.layers.front();
  layer.count = c.strands;
  layer.length = c.length;
  layer.width = c.width;
  layer.lean = c.lean;
  CoatTexture coat;  // one texel
  coat.size = 1;
  coat.texel.resize(1);
  const Fur fur = grow(mesh, scene, coat);
  std::vector<DrawnStrand> strands;
  for (const KeyedStrand& s : fur.strands) strands.push_back(reference::between(fur.keys, s, 0.5f));
  Look look;
  look.shadow = {Shadow::exponential, 256, layer.length, 1 + layer.length * (1 + layer.length_spread)};
  const LightView view = light_view(look);
  reference::LightColumns columns = reference::light_columns(look, view, strands);
  const reference::OpacityMap map = reference::opacity_map(columns);
  Fragments result;
  std::size_t count = 0;
  for (std::size_t texel = 0; texel < columns.size(); ++texel) {
    std::stable_sort(columns[texel].begin(), columns[texel].end(),
                     [](const auto& a, const auto& b) { return a.depth < b.depth; });
    double through = 1;
    for (const reference::LightFragment& f : columns[texel]) {
      result.mean_error += std::abs(reference::texel_light(look, map[texel], f.depth) - through);
      result.optical_depth += -std::log(std::max(map[texel].through, 1e-12));
      through *= 1 - f.alpha;
      ++count;
    }
  }
  result.mean_error /= double(count);
  result.optical_depth /= double(count);
  return result;
}

TEST(StrandShadowError, OfTheReadingExpIsSmallInDenseFur) {
  Scene scene;
  scene.model = "bunny";
  const auto mesh = load_scene_mesh(scene, [](const std::string&) {});
  for (const Case& c :
       {Case{200000, 0.06f, 0.003f, 20}, Case{100000, 0.15f, 0.003f, 50}, Case{40000, 0.2f, 0.008f, 40}}) {
    const Fragments found = compared(*mesh, c);
    EXPECT_GT(found.optical_depth, 3);
    EXPECT_LT(found.mean_error, tolerance::shadow_error) << c.strands << " strands";
  }
}

}  // namespace
}  // namespace pelage::strands
