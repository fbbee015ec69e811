// Tests three properties on a device. The results must not depend on the division of the work into launches
// and work-items. Local forces (pokes) must act locally. Divergence must be reported.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"
#include "harness/springs/model/layout.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "tests/springs/support/scenes.hpp"
#include "tests/support/texts.hpp"

namespace pelage::springs {
namespace {

using namespace test;

using Offsets = std::vector<glm::vec3>;

Offsets after(const SpringNetwork& network, const Dynamics& dynamics, int steps,
              const MassSpringOptions& options = {}, const Offsets& push = {}, int launch = 60) {
  MassSprings springs(queue(), network, dynamics, options);
  springs.push(queue(), push);
  for (int done = 0; done < steps; done += launch) springs.advance(queue(), std::min(launch, steps - done));
  return springs.offsets(queue());
}

bool same_bits(const Offsets& a, const Offsets& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

/// Calls test(kind, solver, network, dynamics) for every topology on the mesh and every solver.
template <class Test>
void for_each_case(const Mesh& mesh, const Test& test) {
  for (const Kind kind : kinds)
    for (const Solver solver : solvers) {
      SCOPED_TRACE(std::string(kind.name) + " " + std::string(solver.name));
      test(kind, solver, build(kind, mesh, fur_length), lively(solver));
    }
}

bool conjugate_gradients(const Kind& kind, const Solver& solver) {
  return kind == Kind::prisms && solver == Solver::backward_euler;
}

/// Expects equal bits, but of conjugate gradients only a small difference.
void expect_alike(const Kind& kind, const Solver& solver, const Offsets& a, const Offsets& b) {
  if (conjugate_gradients(kind, solver))
    EXPECT_LT(largest_difference(a, b), tolerance::stick_top * double(fur_length));
  else
    EXPECT_TRUE(same_bits(a, b));
}

TEST(TopologyDevice, OneSetOfBitsForEveryCutOfTheWork) {
  const auto run = [](Kind kind, Solver solver, const SpringNetwork& network, const Dynamics& d) {
    Offsets once = after(network, d, 120);
    const auto same = [&](const MassSpringOptions& options, int launch) {
      return same_bits(once, after(network, d, 120, options, {}, launch));
    };
    EXPECT_TRUE(same({}, 7)) << "launches of 7 steps";
    // By default, a single work-item simulates such a small model if the device is a CPU. With the option
    // Whole::never, several work-items simulate it.
    const auto never = MassSpringOptions::Whole::never;
    if (conjugate_gradients(kind, solver)) once = after(network, d, 120, {.whole = never});
    EXPECT_TRUE(same({0, 0, 1, never}, 60)) << "a slice per item";
    EXPECT_TRUE(same({0, 5, 3, never}, 60)) << "groups of 5, 3 slices per item";
    EXPECT_FALSE(same_bits(once, after(network, d, 121)));
  };
  for_each_case(sphere(2), run);  // 162 points, which is not a multiple of 16
}

// MassSprings uploads wind and motion for 512 steps at once, so 600 launches of one step need a second
// upload.
TEST(TopologyDevice, SixHundredLaunchesOfAStepAreOneOfSixHundred) {
  for (const Kind kind : {Kind::sticks, Kind::prisms}) {
    const SpringNetwork network = build(kind, square(1), fur_length);
    for (const Solver solver : {Solver::explicit_euler, Solver::rk4}) {
      const Dynamics d = lively(solver);
      EXPECT_TRUE(same_bits(after(network, d, 600, {}, {}, 600), after(network, d, 600, {}, {}, 1)))
          << kind.name << ' ' << solver.name;
    }
  }
}

// One work-item for the whole model gives the same bits as launches of many work-items. Conjugate gradients
// are an exception: one work-item adds the sums in another order and tests the residual more often.
TEST(TopologyDevice, OneWorkItemForTheWholeModelDoesWhatManyDo) {
  using Whole = MassSpringOptions::Whole;
  for_each_case(sphere(2), [](Kind kind, Solver solver, const SpringNetwork& network, const Dynamics& d) {
    const auto moved = [&](Whole whole, int launch) {
      return after(network, d, 60, {.whole = whole}, {}, launch);
    };
    const Offsets one = moved(Whole::always, 60);
    EXPECT_TRUE(same_bits(one, moved(Whole::always, 7)));
    EXPECT_TRUE(same_bits(one, moved(Whole::always, 59))) << "and a single step";
    expect_alike(kind, solver, moved(Whole::never, 60), one);
  });
}

TEST(TopologyDevice, OneWorkItemSolvesToTheResidualToo) {
  const SpringNetwork network = build(Kind::prisms, sphere(2), fur_length);
  const Dynamics d = lively(Solver::backward_euler);
  MassSprings one(queue(), network, d, {.whole = MassSpringOptions::Whole::always}),
      many(queue(), network, d, {.whole = MassSpringOptions::Whole::never});
  for (MassSprings* springs : {&one, &many}) {
    springs->advance(queue(), 30);
    EXPECT_EQ(springs->solves().solves, 30);
    EXPECT_LE(springs->solves().worst_residual, double(d.residual));
    EXPECT_GT(springs->solves().worst_residual, 1e-3 * double(d.residual));
  }
  // A single work-item tests the residual after every iteration. If each part of an iteration has its own
  // launch, the host tests the residual only after every two iterations.
  EXPECT_LE(one.solves().iterations, many.solves().iterations);
  EXPECT_GE(one.solves().iterations, 30);
  EXPECT_GE(30 * one.solves().most_iterations, one.solves().iterations);
}

// If a state is read back and set again with its step number, the simulation continues with the same bits.
// Conjugate gradients are an exception: they restart with the initial guess 0, so the results agree only up
// to the residual.
TEST(TopologyDevice, AStateThatIsPutBackGoesOnAsItDid) {
  const Mesh mesh = sphere(2);
  for_each_case(mesh, [](Kind kind, Solver solver, const SpringNetwork& network, const Dynamics& d) {
    MassSprings one(queue(), network, d), other(queue(), network, d);
    one.advance(queue(), 40);
    const Offsets offsets = one.offsets(queue()), speeds = one.speeds(queue());
    one.advance(queue(), 7);
    other.advance(queue(), 3);
    other.set(queue(), offsets, speeds, 40);
    EXPECT_EQ(other.steps(), 40);
    EXPECT_TRUE(same_bits(other.offsets(queue()), offsets));
    EXPECT_TRUE(same_bits(other.speeds(queue()), speeds));
    other.advance(queue(), 7);
    expect_alike(kind, solver, one.offsets(queue()), other.offsets(queue()));
  });
  const SpringNetwork network = build(Kind::prisms, mesh, fur_length);
  MassSprings springs(queue(), network, lively(Solver::rk4));
  const Offsets none(network.sticks(), glm::vec3(0));
  EXPECT_THROW(springs.set(queue(), none, Offsets(3)), InputError);
  EXPECT_THROW(springs.set(queue(), Offsets(network.sticks(), glm::vec3(NAN)), none), InputError);
  EXPECT_THROW(springs.set(queue(), none, none, -1), InputError);
}

// Drivers compile a kernel anew for each work-group size, which takes seconds. The test therefore uses only
// two combinations of a topology and a solver.
TEST(TopologyDevice, OneSetOfBitsAtOneLaneAndInLargerGroups) {
  const Mesh mesh = sphere(2);
  for (const auto& [kind, solver] : {std::pair(Kind::separable_prisms, Solver::backward_euler),
                                     std::pair(Kind::prisms, Solver::semi_implicit_euler)}) {
    const SpringNetwork network = build(kind, mesh, fur_length);
    const Dynamics d = lively(solver);
    const Offsets once = after(network, d, 120);
    for (const MassSpringOptions& options :
         {MassSpringOptions{0, 64, 0}, MassSpringOptions{1, 0, 0}, MassSpringOptions{1, 16, 2}})
      EXPECT_TRUE(same_bits(once, after(network, d, 120, options)))
          << kind.name << " lanes " << options.lanes << " group " << options.group;
  }
}

TEST(TopologyDevice, APokeOfOneTriangleOfASeparableTopologyStaysThere) {
  const Mesh mesh = sphere(1);
  const auto face = hit(mesh, {0.1, 3, 0.05}, {0, -1, 0});
  ASSERT_TRUE(face.has_value());
  for_each_case(mesh, [&](Kind kind, Solver, const SpringNetwork& network, const Dynamics& d) {
    const Offsets push = poke(network, *face, {0.02f, -0.01f, 0});
    const Offsets calm = after(network, d, 60), poked = after(network, d, 60, {}, push);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < calm.size(); ++i) {
      const bool aimed = push[i] != glm::vec3(0), moved = !same_bits({calm[i]}, {poked[i]});
      EXPECT_TRUE(!aimed || moved) << i;
      EXPECT_TRUE(aimed || !moved || kind == Kind::prisms) << i;
      changed += moved;
    }
    if (kind == Kind::prisms) {
      EXPECT_GT(changed, 10u) << "the wave travels";
    } else {
      EXPECT_EQ(changed, 3u);
    }
  });
}

TEST(TopologyDevice, AnExplosionIsReportedWithItsStepAndMass) {
  for (const Kind kind : kinds) {
    const SpringNetwork network = build(kind, sphere(1), fur_length);
    Dynamics d = lively(Solver::explicit_euler);
    d.stiffness = 1e5f;  // stable only for time steps below 2 * damping / stiffness = 0.4 us
    MassSprings springs(queue(), network, d);
    try {
      for (int i = 0; i < 100; ++i) springs.advance(queue(), 10);
      ADD_FAILURE() << kind.name << " did not explode";
    } catch (const Diverged& said) {
      EXPECT_LT(said.step, 1000);
      EXPECT_GE(said.mass, network.sticks());
      EXPECT_LT(said.mass, 2 * network.sticks());
      const std::string text = said.what();
      EXPECT_NE(text.find("mass " + std::to_string(said.mass)), std::string::npos) << text;
      EXPECT_NE(text.find("step " + std::to_string(said.step)), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      // The reported step must be the first step that fails. A second simulation must therefore succeed in
      // all earlier steps, and fail in the reported step.
      MassSprings again(queue(), network, d);
      EXPECT_NO_THROW(again.advance(queue(), int(said.step)));
      EXPECT_THROW(again.advance(queue(), 1), Diverged);
      EXPECT_THROW(again.advance(queue(), 1), Diverged) << "and stays so";
    }
  }
}

// The springs diverge after about 20 steps. The reported step and mass must be equal for launches of 1, 7 and
// 100 steps.
TEST(TopologyDevice, AnExplosionHasOneStepAndMassHoweverTheLaunchesAreCut) {
  for (const Kind kind : kinds) {
    const SpringNetwork network = build(kind, sphere(1), fur_length);
    Dynamics d = lively(Solver::explicit_euler);
    d.stiffness = 1e4f;
    const auto lost = [&](int launch) {
      MassSprings springs(queue(), network, d);
      try {
        for (int done = 0; done < 100; done += launch) springs.advance(queue(), launch);
      } catch (const Diverged& said) {
        return std::pair(said.step, said.mass);
      }
      ADD_FAILURE() << kind.name << " did not explode";
      return std::pair(-1L, std::size_t(0));
    };
    const auto once = lost(100);
    EXPECT_GT(once.first, 5) << kind.name;
    EXPECT_EQ(lost(1), once) << kind.name;
    EXPECT_EQ(lost(7), once) << kind.name;
  }
}

// If a mass diverges, every solver ends and reports the mass.
TEST(TopologyDevice, AForceThatOneMassCannotBearIsReported) {
  using Whole = MassSpringOptions::Whole;
  for_each_case(sphere(1), [](Kind kind, Solver, const SpringNetwork& network, const Dynamics& d) {
    // Conjugate gradients compute dot products over all masses. If these are floats, a force of 1e30 N
    // makes them overflow. A force of 3e38 N also makes the equations of a single top mass overflow.
    for (const float force : {1e30f, 3e38f})
      for (const Whole whole : {Whole::never, Whole::always}) {
        Offsets push(network.sticks(), glm::vec3(0));
        push[17] = {force, 0, 0};
        MassSprings springs(queue(), network, d, {.whole = whole});
        springs.push(queue(), push);
        try {
          springs.advance(queue(), 5);
          ADD_FAILURE() << force;
        } catch (const Diverged& said) {
          EXPECT_EQ(said.step, 0) << force;
          // If springs connect the top masses, other top masses may diverge in the same step and be
          // reported instead.
          if (!kind.edges) {
            EXPECT_EQ(said.mass, network.top(17));
          }
        }
      }
  });
}

TEST(TopologyDevice, TakesTheMemoryThatIsForetold) {
  for_each_case(sphere(2), [](Kind, Solver solver, const SpringNetwork& network, const Dynamics& d) {
    EXPECT_EQ(MassSprings(queue(), network, d).bytes(), memory(lay_out(network, d.wind), solver));
  });
}

// For an invalid value, the error message is one line that names the value.
TEST(TopologyDevice, RefusesAbsurdDynamics) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  const SpringNetwork network = build(Kind::sticks, square(1), fur_length);
  const auto refused = [&](const char* what, const auto& spoil) {
    Dynamics d = lively(Solver::rk4);
    spoil(d);
    const std::string text = pelage::test::refusal([&] { MassSprings springs(queue(), network, d); });
    EXPECT_NE(text.find(what), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  };
  for (const float bad : {0.0f, -1.0f, nan, infinite}) {
    refused("time step", [&](Dynamics& d) { d.step = bad; });
    refused("mass", [&](Dynamics& d) { d.mass = bad; });
    refused("wavelength", [&](Dynamics& d) { d.wind.wavelength = bad; });
  }
  for (const float bad : {-1.0f, nan, infinite}) {
    refused("stiffness of the sticks", [&](Dynamics& d) { d.stiffness = bad; });
    refused("damping of the sticks", [&](Dynamics& d) { d.damping = bad; });
    refused("stiffness of the springs between tops", [&](Dynamics& d) { d.edge_stiffness = bad; });
    refused("damping of the springs between tops", [&](Dynamics& d) { d.edge_damping = bad; });
    refused("drag", [&](Dynamics& d) { d.drag = bad; });
    refused("return force", [&](Dynamics& d) { d.return_weight = bad; });
    refused("frequency of the gusts", [&](Dynamics& d) { d.wind.frequency = bad; });
  }
  for (const float bad : {nan, infinite}) {
    refused("gravity", [&](Dynamics& d) { d.gravity.y = bad; });
    refused("speed of the wind", [&](Dynamics& d) { d.wind.speed = bad; });
    refused("direction of the wind", [&](Dynamics& d) { d.wind.direction.z = bad; });
    refused("gust of the wind", [&](Dynamics& d) { d.wind.gust = bad; });
    refused("velocity of the object", [&](Dynamics& d) { d.motion.velocity.x = bad; });
    refused("shake of the object", [&](Dynamics& d) { d.motion.shake.x = bad; });
    refused("spin of the object", [&](Dynamics& d) { d.motion.spin = bad; });
    refused("swing of the object", [&](Dynamics& d) { d.motion.swing = bad; });
  }
  refused("direction of the wind", [](Dynamics& d) { d.wind.direction = {0, 0, 0}; });
  refused("axis", [](Dynamics& d) { d.motion.axis = {0, 0, 0}; });

  MassSprings springs(queue(), network, lively(Solver::rk4));
  EXPECT_THROW(springs.push(queue(), Offsets(3)), InputError);
  EXPECT_THROW(springs.push(queue(), Offsets(network.sticks(), glm::vec3(nan))), InputError);
  EXPECT_THROW(springs.enqueue(queue(), 0), InputError);
  EXPECT_THROW(MassSprings(queue(), network, lively(Solver::rk4), {3, 0, 0}), InputError);
}

}  // namespace
}  // namespace pelage::springs
