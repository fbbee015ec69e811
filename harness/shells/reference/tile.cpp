#include "harness/shells/reference/tile.hpp"

#include <algorithm>

namespace pelage::reference {

void blend_over(const FurFragment& over, glm::dvec4& colour) {
  colour = over.coverage * glm::dvec4(over.colour, 1.0) + (1.0 - over.coverage) * colour;
}

void blend_by_depth(Tile& tile) {
  for (std::size_t i = 0; i < tile.waiting.size(); ++i) {
    std::stable_sort(tile.waiting[i].begin(), tile.waiting[i].end(),
                     [](const FurFragment& a, const FurFragment& b) { return a.inverse_w < b.inverse_w; });
    for (const FurFragment& fragment : tile.waiting[i]) blend_over(fragment, tile.colour[i]);
  }
}

}  // namespace pelage::reference
