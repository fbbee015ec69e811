// Compares the reading "exp" of the opacity map with the transmittance towards the light of dense fur
// (docs/strands.md, section Shadow), in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/compare/tolerances.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/groom/fur.hpp"
#include "harness/strands/reference/drawing.hpp"

namespace pelage::strands {
namespace {

struct DenseLook {
  const char* name;
  int strands;
  float length, width;  ///< R
  float lean;           ///< degrees
};
constexpr DenseLook dense_looks[] = {{"short", 200000, 0.06f, 0.003f, 20},
                                     {"combed", 100000, 0.15f, 0.003f, 50},
                                     {"thick", 40000, 0.2f, 0.008f, 40}};

struct DenseFur {
  Fur fur;
  std::vector<DrawnStrand> strands;  ///< at rest
  Look look;                         ///< its shadow is Shadow::exponential
};

/// Returns fur with the values of `look` on the mesh. DenseFur::look has an opacity map of `size` x `size`
/// texels.
DenseFur dense_fur(const Mesh& mesh, const DenseLook& look, int size) {
  StrandsScene scene;
  StrandLayerScene& layer = scene.layers.front();
  layer.count = look.strands;
  layer.length = look.length;
  layer.width = look.width;
  layer.lean = look.lean;
  CoatTexture coat;  // one texel
  coat.size = 1;
  coat.texel.resize(1);
  DenseFur result;
  result.fur = grow(mesh, scene, coat);
  for (const KeyedStrand& s : result.fur.strands)
    result.strands.push_back(reference::between(result.fur.keys, s, 0.5f));
  result.look.shadow = {Shadow::exponential, size, layer.length,
                        1 + layer.length * (1 + layer.length_spread)};
  return result;
}

/// A fragment in the light's view.
struct LightSample {
  std::size_t texel = 0;  ///< number of its texel, row by row
  double depth = 0;       ///< R
  double through = 1;     ///< product of 1 - alpha over the fragments of the texel that lie before it
};

/// Returns the fragments of all texels, in each texel by ascending depth.
std::vector<LightSample> light_samples(reference::LightColumns columns) {
  std::vector<LightSample> samples;
  for (std::size_t texel = 0; texel < columns.size(); ++texel) {
    std::stable_sort(columns[texel].begin(), columns[texel].end(),
                     [](const auto& a, const auto& b) { return a.depth < b.depth; });
    double through = 1;
    for (const reference::LightFragment& f : columns[texel]) {
      samples.push_back({texel, f.depth, through});
      through *= 1 - f.alpha;
    }
  }
  return samples;
}

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
