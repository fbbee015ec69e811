#include "harness/compare/dense_fur.hpp"

#include <algorithm>

#include "harness/strands/reference/keyed.hpp"

namespace pelage {

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
  result.fur = strands::grow(mesh, scene, coat);
  for (const strands::KeyedStrand& s : result.fur.strands)
    result.strands.push_back(strands::reference::between(result.fur.keys, s, 0.5f));
  result.look.shadow = {strands::Shadow::exponential, size, layer.length,
                        1 + layer.length * (1 + layer.length_spread)};
  return result;
}

std::vector<LightSample> light_samples(strands::reference::LightColumns columns) {
  std::vector<LightSample> samples;
  for (std::size_t texel = 0; texel < columns.size(); ++texel) {
    std::stable_sort(columns[texel].begin(), columns[texel].end(),
                     [](const auto& a, const auto& b) { return a.depth < b.depth; });
    double through = 1;
    for (const strands::reference::LightFragment& f : columns[texel]) {
      samples.push_back({texel, f.depth, through});
      through *= 1 - f.alpha;
    }
  }
  return samples;
}

}  // namespace pelage
