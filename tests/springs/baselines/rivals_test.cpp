// A baseline is another implementation of the solvers: serial C++ loops or the library Eigen. This file tests
// that every baseline solves the same equations as the reference. Otherwise the baseline's times could not be
// compared with those of the OpenCL solvers.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "harness/compare/tolerances.hpp"
#include "harness/springs/baselines/baselines.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/springs/support/meshes.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;

struct Case {
  Kind kind;
  Solver solver;
};

struct Rivals : testing::TestWithParam<Case> {};

double largest_difference(const std::vector<glm::vec3>& a, const std::vector<glm::dvec3>& b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double d = glm::distance(glm::dvec3(a[i]), b[i]);
    worst = d < 1e9 ? std::max(worst, d) : 1e9;
  }
  return worst;
}

// Tests objects at rest and rotating objects, with meshes of 4, 16 and 320 triangles. The serial baselines
// process blocks of 256 triangles or sticks; a mesh of 320 triangles needs more than one block.
TEST_P(Rivals, AreTheReferenceAfterASecondOfWind) {
  for (const bool turning : {false, true})
    for (const Mesh& mesh : {square(1), square(2), sphere(2)}) {
      Dynamics dynamics = lively(GetParam().solver);
      if (!turning) dynamics.motion = {};
      dynamics.residual = 1e-6f;
      const int steps = int(std::lround((turning ? 0.25 : 1) / double(dynamics.step)));
      const SpringNetwork topology = build(GetParam().kind, mesh, fur_length);
      const reference::System system{topology, dynamics};
      reference::State expected = reference::rest(topology);
      Motions start;
      for (const glm::dvec3& q : reference::offsets(topology, expected)) {
        start.offset.emplace_back(q);
        start.speed.emplace_back(0.0f);
      }
      for (int i = 0; i < steps; ++i) expected = reference::step(system, expected, i);
      const auto offsets = reference::offsets(topology, expected);

      const auto rivals = solver_rivals(topology, dynamics);
      EXPECT_GE(rivals.size(), 2u);
      for (const auto& [name, rival, threads] : rivals) {
        rival->set(start);
        for (int done = 0; done < steps; done += 40) {
          const int count = std::min(40, steps - done);
          rival->advance(moments(dynamics, done, count), count);
        }
        const double error = largest_difference(rival->state().offset, offsets) / double(fur_length);
        // Baselines in double precision still read some inputs and the initial state as floats. All other
        // baselines also compute in floats and have a larger limit.
        EXPECT_LT(error, name.find("double") != std::string::npos ? tolerance::double_baseline
                                                                  : tolerance::stick_top)
            << name << ", " << topology.sticks() << " sticks";
        rival->set(start);
        EXPECT_EQ(rival->state().offset, start.offset) << name;
      }
    }
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const Kind kind : kinds)
    for (const Solver solver : solvers) cases.push_back({kind, solver});
  return cases;
}

std::string case_name(const testing::TestParamInfo<Case>& given) {
  std::string text = std::string(name(given.param.kind)) + "_" + std::string(name(given.param.solver));
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}

INSTANTIATE_TEST_SUITE_P(All, Rivals, testing::ValuesIn(all_cases()), case_name);

}  // namespace
}  // namespace pelage::springs
