// What glm leaves open.
#pragma once
#include <glm/geometric.hpp>

namespace pelage::reference {

/// v / |v|; the zero vector stays zero (docs/frame.md).
template <class V>
V unit(const V& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : v;
}

}  // namespace pelage::reference
