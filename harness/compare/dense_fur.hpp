// Three looks of dense fur, on which the readings of the opacity map are compared with the transmittance
// towards the light (docs/strands.md, section Shadow).
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/groom/fur.hpp"
#include "harness/strands/reference/opacity_map.hpp"

namespace pelage {

struct DenseLook {
  const char* name;
  int strands;
  float length, width;  ///< R
  float lean;           ///< degrees
};
inline constexpr std::array<DenseLook, 3> dense_looks{{{"short", 200000, 0.06f, 0.003f, 20},
                                                       {"combed", 100000, 0.15f, 0.003f, 50},
                                                       {"thick", 40000, 0.2f, 0.008f, 40}}};

struct DenseFur {
  strands::Fur fur;
  std::vector<strands::DrawnStrand> strands;  ///< at rest
  strands::Look look;                         ///< its shadow is Shadow::exponential
};

/// Returns fur with the values of `look` on the mesh. DenseFur::look has an opacity map of `size` x `size`
/// texels.
DenseFur dense_fur(const Mesh& mesh, const DenseLook& look, int size);

/// A fragment in the light's view.
struct LightSample {
  std::size_t texel = 0;  ///< number of its texel, row by row
  double depth = 0;       ///< R
  double through = 1;     ///< product of 1 - alpha over the fragments of the texel that lie before it
};

/// Returns the fragments of all texels, in each texel by ascending depth.
std::vector<LightSample> light_samples(strands::reference::LightColumns columns);

}  // namespace pelage
