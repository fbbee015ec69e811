// The device on which the tests in tests/springs run, and a function that compares two lists of vectors.
#pragma once
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "harness/cl/program.hpp"

namespace pelage::springs::test {

/// Returns a queue on the device that $PELAGE_DEVICE selects, or else on the first device.
inline const cl::Queue& queue() {
  static const cl::Queue shared(cl::choose_device(""));
  return shared;
}

/// Returns the largest distance between entries of equal index. If an entry is not finite, returns 1e9.
template <class A, class B>
double largest_difference(const std::vector<A>& a, const std::vector<B>& b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    const double d = glm::distance(glm::dvec3(a[i]), glm::dvec3(b[i]));
    worst = d < 1e9 ? std::max(worst, d) : 1e9;
  }
  return worst;
}

}  // namespace pelage::springs::test
