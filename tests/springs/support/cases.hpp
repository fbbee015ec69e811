// The topologies and solvers for which parameterized tests run, and a comparison of two lists of vectors.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "harness/springs/model/network.hpp"

namespace pelage::springs::test {

struct Case {
  Kind kind;
  Solver solver;
};

inline std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const Kind kind : kinds)
    for (const Solver solver : solvers) cases.push_back({kind, solver});
  return cases;
}

/// kind_name() and case_name() return a part of a test's name, in which '-' is not permitted.
inline std::string with_underscores(std::string text) {
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}
inline std::string kind_name(const testing::TestParamInfo<Kind>& given) {
  return with_underscores(std::string(name(given.param)));
}
inline std::string case_name(const testing::TestParamInfo<Case>& given) {
  return with_underscores(std::string(name(given.param.kind)) + "_" + std::string(name(given.param.solver)));
}

/// Returns one force in newtons per stick: `force` for the sticks at the corners of triangle `face`, else 0.
inline std::vector<glm::vec3> poke(const SpringNetwork& topology, std::size_t face, glm::vec3 force) {
  std::vector<glm::vec3> push(topology.sticks(), glm::vec3(0));
  for (int c = 0; c < 3; ++c) push[topology.corner[face][c]] = force;
  return push;
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
