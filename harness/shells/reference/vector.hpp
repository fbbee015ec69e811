// Normalization that is defined for the zero vector, too.
#pragma once
#include <glm/geometric.hpp>

namespace pelage::reference {

/// Returns v / |v|, or 0 for the zero vector (docs/shells.md).
template <class V>
V unit(const V& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : v;
}

}  // namespace pelage::reference
