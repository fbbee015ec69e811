// Each scheme of each topology against the independent reference: the kernels' text in double, which must
// agree to the records' rounding, and the device, which must agree to 1e-4 of the fur's length.
#include <gtest/gtest.h>

#include "harness/topology/mass_springs.hpp"
#include "harness/topology/reference.hpp"
#include "tests/topology/device.hpp"
#include "tests/topology/meshes.hpp"
#include "tests/topology/scenes.hpp"
#include "tests/topology/shim.hpp"

namespace pelage::springs {
namespace {

using namespace test;

reference::State run(const reference::System& system, int steps) {
  reference::State state = reference::rest(system.topology);
  for (int i = 0; i < steps; ++i) state = reference::step(system, state, i);
  return state;
}

struct Case {
  Kind kind;
  Solver solver;
};

std::string case_name(const testing::TestParamInfo<Case>& given) {
  std::string text = std::string(name(given.param.kind)) + "_" + std::string(name(given.param.solver));
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const Kind kind : kinds)
    for (const Solver solver : solvers) cases.push_back({kind, solver});
  return cases;
}

struct Steps : testing::TestWithParam<Case> {};

TEST_P(Steps, AreTheReferencesAfterASecondOfWind) {
  const Dynamics dynamics = lively(GetParam().solver);
  const int steps = int(std::lround(1 / dynamics.step));
  for (const Mesh& mesh : {square(1), square(2), sphere(1)}) {  // 5, 13 and 42 points; 4, 16 and 80 triangles
    const Topology topology = build(GetParam().kind, mesh, fur_length);
    reference::System system{topology, dynamics};
    system.push.assign(topology.sticks(), glm::dvec3(0));
    const std::vector<glm::vec3> force = poke(topology, 1, {0.004f, -0.01f, 0.006f});
    for (std::size_t i = 0; i < force.size(); ++i) system.push[i] = glm::dvec3(force[i]);
    const reference::State expected = run(system, steps);
    const auto offsets = reference::offsets(topology, expected);
    EXPECT_GT(largest_difference(reference::offsets(topology, reference::rest(topology)), offsets), 0.01)
        << "something moved";

    Shim shim(topology, dynamics);
    shim.push(force);
    for (int done = 0; done < steps; done += 50) shim.advance(std::min(50, steps - done));
    // Weight, moments, 1/m and a unit normal are floats in the records.
    EXPECT_LT(largest_difference(shim.offsets(), offsets), 1e-6 * double(fur_length));

    MassSprings device(queue(), topology, dynamics);
    device.push(queue(), force);
    for (int done = 0; done < steps; done += 50) device.advance(queue(), std::min(50, steps - done));
    EXPECT_LT(largest_difference(device.offsets(queue()), offsets), 1e-4 * double(fur_length));
    std::printf("%zu sticks: kernels in double %.2g, device %.2g of the fur's length\n", topology.sticks(),
                largest_difference(shim.offsets(), offsets) / double(fur_length),
                largest_difference(device.offsets(queue()), offsets) / double(fur_length));
  }
}

INSTANTIATE_TEST_SUITE_P(All, Steps, testing::ValuesIn(all_cases()), case_name);

}  // namespace
}  // namespace pelage::springs
