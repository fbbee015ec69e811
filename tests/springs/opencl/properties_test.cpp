// Tests properties that need no comparison with the reference's motion. These are the solvers' orders of
// convergence, the rest state, the energy, and the effect of the return force (Eq. 5 of paper B, Banisch and
// Wuethrich 2006).
#include <gtest/gtest.h>

#include <cmath>

#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/springs/reference/reference.hpp"
#include "tests/springs/opencl/shim.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;

constexpr double length = fur_length;

struct PropertiesOf : testing::TestWithParam<Kind> {};

// A system without return force (Eq. 5 of paper B), damping and drag, which is conservative. Each top starts
// with another velocity.
struct Conservative {
  SpringNetwork network;
  Dynamics d;
  reference::State state = reference::rest(network);
  double start;
  Shim shim;

  Conservative(SpringNetwork built, Solver solver, float step)
      : network(std::move(built)), d(without_losses(solver, step)), start(0), shim(network, d) {
    std::vector<glm::dvec3> speeds(network.sticks());
    for (std::size_t i = 0; i < speeds.size(); ++i)
      speeds[i] = glm::dvec3(0.3 * std::sin(double(i)), 0.2, 0.3 * std::cos(double(i)));
    shim.set(reference::offsets(network, state), speeds);
    start = energy();
  }
  static Dynamics without_losses(Solver solver, float step) {
    Dynamics d = still(solver);
    d.return_weight = d.damping = d.edge_damping = 0;
    d.step = step;
    return d;
  }
  double energy() {
    const auto q = shim.offsets(), v = shim.speeds();
    for (std::size_t i = 0; i < q.size(); ++i) {
      state.position[network.top(i)] = state.position[i] + q[i];
      state.velocity[network.top(i)] = v[i];
    }
    return reference::energy({network, d}, state);
  }
};

// Simulates 0.0625 s with each solver, once with a coarse time step and once with half this time step. The
// error is the difference from RK4 with 2048 steps. Halving the time step must divide the error by 2^order,
// where `order` is the order of the solver.
TEST_P(PropertiesOf, OrdersOfConvergence) {
  const SpringNetwork network = build(GetParam(), square(1), fur_length);
  const auto offsets_after = [&](Solver solver, int steps) {
    Dynamics d = lively(solver);
    d.step = 0.0625f / float(steps);  // exactly representable
    Shim shim(network, d);
    shim.advance(steps);
    return shim.offsets();
  };
  const auto truth = offsets_after(Solver::rk4, 2048);
  for (const Solver solver : solvers) {
    const int steps = solver == Solver::rk4 ? 32 : solver == Solver::predictor_corrector ? 128 : 512;
    const double coarse = largest_difference(offsets_after(solver, steps), truth),
                 fine = largest_difference(offsets_after(solver, 2 * steps), truth);
    const double order = std::log2(coarse / fine);
    std::printf("%s %s: order %.3f, error %.2g of the fur's length\n", GetParam().name.data(),
                solver.name.data(), order, fine / length);
    EXPECT_NEAR(order,
                solver == Solver::rk4                   ? 4
                : solver == Solver::predictor_corrector ? 2
                                                        : 1,
                0.2)
        << solver.name;
  }
}

TEST_P(PropertiesOf, WithoutForcesNothingMoves) {
  const SpringNetwork network = build(GetParam(), sphere(1), fur_length);
  const auto rest = reference::offsets(network, reference::rest(network));
  for (const Solver solver : solvers) {
    Dynamics d = still(solver);
    // still() sets a time step of 1/240 s. With this step, explicit Euler would amplify rounding errors, so
    // the test uses the time step of lively(), which is 1 ms for explicit Euler.
    d.step = lively(solver).step;
    Shim shim(network, d);
    shim.advance(500);
    MassSprings device(queue(), network, d);
    device.advance(queue(), 500);
    // Normals, positions and rest lengths have values up to about 1 (lengths in R, the mesh radius). Rounding
    // to floats changes these values by up to 6e-8. Differences of positions on the device have a rounding
    // error of the same size.
    EXPECT_LT(largest_difference(shim.offsets(), rest), 6e-8) << solver.name;
    EXPECT_LT(largest_difference(device.offsets(queue()), rest), 1.2e-7) << solver.name;
  }
}

// Semi-implicit Euler is symplectic and keeps the energy within a band at all times.
TEST_P(PropertiesOf, EnergyStaysBoundedOver100000Steps) {
  Conservative fur(build(GetParam(), square(1), fur_length), Solver::semi_implicit_euler, 1e-3f);
  ASSERT_GT(fur.start, 1e-5);
  double least = fur.start, most = fur.start, early = 0, late = 0;
  for (int i = 0; i < 1000; ++i) {
    fur.shim.advance(100);
    const double energy = fur.energy();
    least = std::min(least, energy), most = std::max(most, energy);
    (i < 500 ? early : late) += energy / 500;
  }
  std::printf("%s: energy from %.3f to %.3f of the start's; mean of the halves %.4f and %.4f\n",
              GetParam().name.data(), least / fur.start, most / fur.start, early / fur.start,
              late / fur.start);
  EXPECT_GT(least, 0.8 * fur.start);
  EXPECT_LT(most, 1.2 * fur.start);
  EXPECT_NEAR(late / early, 1, 0.02) << "no drift";
}

// Backward Euler must never increase the energy.
TEST_P(PropertiesOf, BackwardEulerLosesEnergy) {
  Conservative fur(build(GetParam(), square(2), fur_length), Solver::backward_euler, 1.0f / 60);
  double last = fur.start;
  for (int i = 0; i < 60; ++i) {
    fur.shim.advance(5);
    const double energy = fur.energy();
    EXPECT_LE(energy, last * (1 + 1e-6)) << i;
    last = energy;
  }
  EXPECT_LT(last, 0.5 * fur.start);
}

// A stick is tilted and released. The return force (Eq. 5 of paper B) moves the stick back to its normal, and
// each swing is smaller than the swing before.
TEST_P(PropertiesOf, Equation5BringsTheFurBackWithDecayingPeaks) {
  const SpringNetwork network = build(GetParam(), square(1), fur_length);
  Dynamics d = still(Solver::semi_implicit_euler);
  d.step = 1e-3f;
  d.drag = 0.002f;
  std::vector<glm::dvec3> q = reference::offsets(network, reference::rest(network));
  for (glm::dvec3& offset : q) offset = length * glm::normalize(glm::dvec3(1, 0.6, 0));  // 59 degrees
  Shim shim(network, d);
  shim.set(q, std::vector<glm::dvec3>(q.size(), glm::dvec3(0)));
  const auto lean = [&] {
    const glm::dvec3 s = glm::normalize(shim.offsets()[0]);
    return std::atan2(s.x, s.y);
  };
  double before = lean(), highest = std::abs(before);
  std::vector<double> peaks{highest};
  highest = 0;
  for (int i = 0; i < 20000; ++i) {
    shim.advance(1);
    const double now = lean();
    if ((now > 0) != (before > 0)) peaks.push_back(highest), highest = 0;
    if (peaks.size() > 1 || (now > 0) != (before > 0)) highest = std::max(highest, std::abs(now));
    before = now;
  }
  // The loop does not update `highest` before the angle's first change of sign, so peaks[1] is 0.
  peaks.erase(peaks.begin() + 1);
  ASSERT_GE(peaks.size(), 4u);
  for (std::size_t i = 1; i < peaks.size(); ++i) EXPECT_LT(peaks[i], peaks[i - 1]) << i;
  EXPECT_LT(peaks.back(), 0.5 * peaks.front());
}

// Paper B says: "Grass does therefore not flip to the wrong side". In this test, gravity acts towards the
// skin. The force of gravity on a top mass (0.01 N) is smaller than the weight w = 0.2 N of Eq. 5 of paper B.
// Therefore no top mass may sink below the plane of its root. Without the return force, the top masses must
// sink below this plane.
TEST_P(PropertiesOf, Equation5KeepsTheLayersAboveTheSkin) {
  const SpringNetwork network = build(GetParam(), square(2), fur_length);
  for (const float weight : {0.2f, 0.0f}) {
    Dynamics d = still(Solver::semi_implicit_euler);
    d.drag = 0.004f;
    d.gravity = {1, -9.81f, 0.5f};
    d.return_weight = weight;
    Shim shim(network, d);
    double lowest = 1;
    for (int i = 0; i < 100; ++i) {
      shim.advance(24);
      for (const glm::dvec3& q : shim.offsets()) lowest = std::min(lowest, q.y);
    }
    if (weight > 0) {
      EXPECT_GT(lowest, 0);
    } else {
      EXPECT_LT(lowest, -0.5 * length);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Topologies, PropertiesOf, testing::ValuesIn(kinds), pelage::test::by_parameter);

TEST(Equation5, IsZeroAtRestAndGrowsWithTheAngle) {
  const SpringNetwork network = build(Kind::sticks, square(1), fur_length);
  Dynamics d = still(Solver::explicit_euler);
  d.stiffness = d.damping = 0;
  const reference::System system{network, d};
  reference::State state = reference::rest(network);
  EXPECT_LT(glm::length(reference::forces(system, state, 0)[network.top(0)]), 1e-14);
  double last = 0;
  for (int degrees = 10; degrees <= 180; degrees += 10) {
    const double angle = degrees * std::acos(-1.0) / 180;
    state.position[network.top(0)] =
        state.position[0] + length * glm::dvec3(std::sin(angle), std::cos(angle), 0);
    const glm::dvec3 f = reference::forces(system, state, 0)[network.top(0)];
    // |n - s| = 2 sin(angle / 2), 1 - n.s = 2 sin^2(angle / 2)
    EXPECT_NEAR(glm::length(f), double(d.return_weight) * 4 * std::pow(std::sin(angle / 2), 3), 1e-7);
    EXPECT_GT(glm::length(f), last);
    last = glm::length(f);
  }
}

}  // namespace
}  // namespace pelage::springs
