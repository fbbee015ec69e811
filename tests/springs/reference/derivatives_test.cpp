// Compares the reference's formulas for the derivatives of the forces with finite differences of the
// reference's forces.
#include <gtest/gtest.h>

#include "tests/springs/support/cases.hpp"
#include "tests/springs/support/differences.hpp"
#include "tests/springs/support/meshes.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs {
namespace {

using namespace test;

Matrix matrix_of(const reference::Derivatives& found, bool by_velocity) {
  const auto size = Eigen::Index(found.size);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>((by_velocity ? found.by_velocity : found.by_position).data(), size, size);
}

struct Derivatives : testing::TestWithParam<Kind> {};

TEST_P(Derivatives, AllTermsAreTheFiniteDifferencesOfTheForces) {
  const SpringNetwork topology = build(GetParam(), sphere(0), fur_length);
  Dynamics d = lively(Solver::backward_euler);  // the object rotates
  d.full_jacobian = true;
  d.edge_stiffness = 5;
  d.edge_damping = 0.05f;
  d.return_weight = 0.8f;
  for (const reference::State& state : {crumpled(topology), stretched(topology)})
    for (const bool by_velocity : {false, true}) {
      const reference::System system{topology, d};
      const Matrix expected = differences(system, state, 0.37, by_velocity);
      const Matrix found = matrix_of(reference::derivatives(system, state, 0.37), by_velocity);
      EXPECT_LT((found - expected).norm(), 1e-7 * expected.norm()) << by_velocity;
      EXPECT_GT((found - found.transpose()).norm(), 1e-3 * expected.norm()) << "asymmetric";
    }
}

TEST_P(Derivatives, OfAPrunedStepAreTheFiniteDifferencesOnStretchedSprings) {
  const SpringNetwork topology = build(GetParam(), sphere(0), fur_length);
  const Dynamics d = stiff_step();
  const reference::State state = stretched(topology);
  for (std::size_t k = 0; k < topology.spring.size(); ++k) {
    const glm::uvec2 ends = topology.spring[k];
    ASSERT_GT(glm::distance(state.position[ends.x], state.position[ends.y]), double(topology.rest[k]));
  }
  const reference::System system{topology, d};
  const Step step = step_by_differences(system, state, 0);
  const reference::State next = reference::step(system, state, 0);
  EXPECT_LT(residual_of(step, speeds_of(topology, state), speeds_of(topology, next)), 1e-8);
  // By default, the reference omits some terms of the derivatives. The remaining derivatives with respect to
  // the positions form a symmetric matrix.
  const Matrix j = matrix_of(reference::derivatives(system, state, d.step), false);
  EXPECT_LT((j - j.transpose()).norm(), 1e-12 * j.norm());
}

// By default, the reference omits some terms of the derivatives (dynamics.springs.jacobian = "pruned"). If a
// stick is compressed, the derivative of its force must then contain only the stiffness along the stick.
TEST(DerivativesOfAStick, KeepOnlyTheForceAlongACompressedSpring) {
  const SpringNetwork topology = build(Kind::sticks, square(1), fur_length);
  Dynamics d = still(Solver::backward_euler);
  d.return_weight = 0;
  reference::State state = reference::rest(topology);
  for (std::size_t i = 0; i < topology.sticks(); ++i)
    state.position[topology.top(i)] = state.position[i] + glm::dvec3(0.01, 0.02 + 0.002 * double(i), -0.015);
  const reference::System system{topology, d};
  const Matrix exact = differences(system, state, 0, false);
  const Matrix found = matrix_of(reference::derivatives(system, state, 0), false);
  for (std::size_t i = 0; i < topology.sticks(); ++i) {
    const glm::dvec3 q = state.position[topology.top(i)] - state.position[i];
    ASSERT_LT(glm::length(q), double(fur_length));
    const glm::dvec3 s = glm::normalize(q);
    const Eigen::Vector3d along(s.x, s.y, s.z);
    const Eigen::Matrix3d own = exact.block<3, 3>(Eigen::Index(3 * i), Eigen::Index(3 * i));
    const Eigen::Matrix3d kept = along * along.transpose() * own;
    EXPECT_LT((found.block<3, 3>(Eigen::Index(3 * i), Eigen::Index(3 * i)) - kept).norm(), 1e-7 * own.norm());
    EXPECT_GT((own - kept).norm(), 0.1 * own.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Derivatives, testing::ValuesIn(kinds.begin(), kinds.end()), kind_name);

}  // namespace
}  // namespace pelage::springs
