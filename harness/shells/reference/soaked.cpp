#include "harness/shells/reference/soaked.hpp"

#include <algorithm>

namespace pelage::reference {

double soaked_share(const SoakedScene& soaked, double rho) {
  const double threshold = double(soaked.threshold);
  if (threshold >= 1.0) return 0.0;
  const double x = std::clamp((rho - threshold) / (1.0 - threshold), 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

double film_coverage(const Scene& scene, double h) {
  return std::clamp((double(scene.soaked.height) - h) * double(scene.fur.layers) + 1.0, 0.0, 1.0);
}

double cover_with_film(FurSample& fur, double share, double coverage) {
  if (share == 0.0) return 0.0;
  const double strands = (1.0 - share) * fur.coverage, film = share * coverage;
  fur.coverage = strands + film;
  if (!(fur.coverage > 0.0)) return 0.0;
  fur.shade = (strands > 0.0 ? strands * fur.shade : 0.0) / fur.coverage + film / fur.coverage;
  return film / fur.coverage;
}

}  // namespace pelage::reference
