// Soaked fur (docs/shells.md, section 11): where the wetness exceeds a threshold, a film of water replaces
// the clumps.
#pragma once
#include "harness/scene/scene.hpp"
#include "harness/shells/reference/textures.hpp"

namespace pelage::reference {

/// Returns S, the part of fur of the wetness rho (0 to 1) that the film covers, 0 to 1.
double soaked_share(const SoakedScene& soaked, double rho);

/// Returns the coverage of the film in a layer of the height h: 1 up to soaked.height, and 0 from one layer
/// above it.
double film_coverage(const Scene& scene, double h);

/// Adds the film to a sample of the fur. `share`: the part of the surface that the film covers. `coverage`:
/// the film's coverage in this layer. Returns the part of the new coverage that is film.
double cover_with_film(FurSample& fur, double share, double coverage);

}  // namespace pelage::reference
