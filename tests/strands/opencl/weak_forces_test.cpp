// Compares chains under weak forces with the double-precision reference over 2 s: the chains of the device,
// and the kernels' equations compiled in double precision. Rounding must not stop a strand that moves in the
// reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "harness/compare/tolerances.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "tests/strands/support/strands.hpp"
#include "tests/support/opencl_as_cpp.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
namespace pelage::in_double {
#include "strands/chain/step.clh"
}  // namespace pelage::in_double
#pragma GCC diagnostic pop

namespace pelage::strands::test {
namespace {

namespace k = in_double;

struct WeakForce {
  std::string name;
  float wind = 0;         ///< dynamics.wind.strength, N
  float gravity = 0;      ///< R/s^2
  float stiffness = 800;  ///< k1, 1/s^2
  float lean = 40;        ///< angle between the normal and the direction at rest, degrees
  float limit = 80;       ///< largest angle of both segments, degrees
};

/// The forces of an outside comparison of the device with the reference. With these forces, no strand touches
/// a stop.
std::vector<WeakForce> weak_forces() {
  return {{.name = "wind 0.0001 N", .wind = 0.0001f},
          {.name = "wind 0.0003 N", .wind = 0.0003f},
          {.name = "wind 0.001 N", .wind = 0.001f},
          {.name = "wind 0.003 N", .wind = 0.003f},
          {.name = "gravity, k1 = 100 / s^2", .gravity = -9.81f, .stiffness = 100},
          {.name = "gravity, k1 = 1600 / s^2", .gravity = -9.81f, .stiffness = 1600}};
}

/// Forces that press the strands against the skin and against a limit.
std::vector<WeakForce> pressing_forces() {
  return {{.name = "skin", .gravity = -9.81f, .stiffness = 100, .lean = 88},
          {.name = "limit", .gravity = -9.81f, .stiffness = 100, .limit = 10}};
}

constexpr int weak_steps = 484;  // 121 frames of 4 steps, as in 2 s before the first picture

std::vector<Chain> chains_under(const WeakForce& force) {
  std::vector<Chain> chains = sphere_of(60);
  for (Chain& chain : chains) {
    const glm::vec3 comb(0, -1, -0.25f);
    const glm::vec3 along = glm::normalize(comb - glm::dot(comb, chain.normal) * chain.normal);
    const float angle = glm::radians(force.lean);
    chain.rest = glm::normalize(std::cos(angle) * chain.normal + std::sin(angle) * along);
    chain.length = 0.3f;
    chain.stiffness_first = force.stiffness;
    chain.stiffness_second = force.stiffness / 2;
    chain.limit_first = chain.limit_second = force.limit;
  }
  return chains;
}

ChainDynamics dynamics_under(const WeakForce& force) {
  ChainDynamics d;
  d.gravity = {0, force.gravity, 0};
  d.wind.direction = {1, 0, 0};
  d.wind.speed = force.wind / (0.001f * d.drag);  // the scene's default mass is 0.001 kg
  return d;
}

/// F, the sum of the forces on the segments of a strand, 1/s^2.
double force_on(const Chain& chain, const ChainDynamics& d) {
  const double pull = (double(glm::length(d.gravity)) + double(d.drag * d.wind.speed)) / double(chain.length);
  return double(chain.stiffness_first + 2 * chain.stiffness_second) + 2 * pull;
}

/// The greatest distance of a direction of a strand from the reference after N steps that rounding explains,
/// if the strand has touched no stop: e (2 sqrt(N) + 16 + 8 F/k), where e = 2^-24 is the relative rounding
/// error, F = k1 + 2 k2 + |Gu| + |Gw| (docs/strands.md, section "Model"; force_on() is an upper bound) and
/// k = min(k1, k2).
/// - 2 sqrt(N): in each step, u+du and the Newton step of item 4 round a direction by sqrt(3) e. The errors
/// of
///   different steps are independent, so their sum grows with sqrt(N) (Higham and Mary, A New Approach to
///   Probabilistic Rounding Error Analysis, 2019).
/// - 16: the rates have a relative error of up to 16 e, and a strand turns by at most about 1 rad in total.
/// - 8 F/k: errors of the forces of up to 8 e F turn the equilibrium by 8 e F/k.
/// With the default stiffnesses, this is 6e-6 after 2 s.
double rounding_bound(const Chain& chain, const ChainDynamics& d, int steps) {
  const double softer = double(std::min(chain.stiffness_first, chain.stiffness_second));
  return std::ldexp(2 * std::sqrt(double(steps)) + 16 + 8 * force_on(chain, d) / softer, -24);
}

/// The bound for strands that touch a stop. The computed gap of a stop is wrong by at most 1e-6, so the
/// kinetic energy of a strand that meets a stop has an error of up to 1e-6 F. With this energy, the strand
/// moves by h sqrt(2e-6 F/A) in a step.
double stop_bound(const Chain& chain, const ChainDynamics& d, int steps) {
  const double inertia = std::pow(double(d.first_segment), 2);
  return rounding_bound(chain, d, steps) + double(d.step) * std::sqrt(2e-6 * force_on(chain, d) / inertia);
}

/// The states of all chains after a number of steps, in double precision.
using States = std::function<std::vector<reference::State>(int steps)>;

/// Compares the states with the reference every 44 steps. The directions of no strand may differ by more than
/// the bound, so a strand that moves by more than the bound in the reference also moves. `states` is called
/// with a rising number.
void expect_motion_of_reference(const WeakForce& force, const States& states, bool pressed) {
  const std::vector<Chain> chains = chains_under(force);
  const ChainDynamics d = dynamics_under(force);
  std::vector<reference::State> exact;
  exact.reserve(chains.size());
  for (const Chain& chain : chains) exact.push_back(reference::at_rest(chain));
  double worst = 0, share = 0, moved = 0;
  int touching = 0;
  for (int steps = 44; steps <= weak_steps; steps += 44) {
    const std::vector<reference::State> found = states(steps);
    for (std::size_t i = 0; i < chains.size(); ++i) {
      for (int k = steps - 44; k < steps; ++k) exact[i] = reference::step(chains[i], d, exact[i], k);
      const double error =
          std::max(glm::distance(found[i].u, exact[i].u), glm::distance(found[i].w, exact[i].w));
      const double bound = (pressed ? stop_bound : rounding_bound)(chains[i], d, steps);
      EXPECT_LT(error, bound) << force.name << ", strand " << i << ", step " << steps;
      worst = std::max(worst, error);
      share = std::max(share, error / bound);
      moved = std::max(moved, glm::distance(exact[i].w, glm::dvec3(chains[i].rest)));
      touching += *std::max_element(exact[i].stop.begin(), exact[i].stop.end()) > 0;
    }
  }
  std::printf("%s: strands move by up to %.1e; largest error %.1e, %.2f of its bound\n", force.name.c_str(),
              moved, worst, share);
  EXPECT_GT(moved, 1e-4) << force.name;
  EXPECT_EQ(touching > 0, pressed) << force.name;
}

States on_device(const WeakForce& force, int lanes) {
  ChainOptions options;
  options.lanes = lanes;
  const auto strands = std::make_shared<Chains>(queue(), chains_under(force), dynamics_under(force), options);
  return [strands](int steps) {
    while (strands->steps() < steps) strands->enqueue(queue(), 4);
    std::vector<reference::State> found;
    for (const ChainState& state : strands->states(queue())) found.push_back(reference::in_double(state));
    return found;
  };
}

TEST(WeakForces, MoveTheStrandsOfTheDeviceLikeTheReference) {
  for (const WeakForce& force : weak_forces())
    for (const int lanes : {1, 16}) expect_motion_of_reference(force, on_device(force, lanes), false);
}

TEST(WeakForces, MoveStrandsAlongTheirStops) {
  for (const WeakForce& force : pressing_forces())
    expect_motion_of_reference(force, on_device(force, 0), true);
}

// A strand that nearly rests has little energy. The reference must compute its step from the rounded state,
// too.
TEST(WeakForces, SingleStepsNearRestAgreeWithTheReference) {
  for (const WeakForce& force : weak_forces()) {
    const Errors errors = step_errors(chains_under(force), dynamics_under(force), 24);
    const double worst = *std::max_element(errors.direction.begin(), errors.direction.end());
    std::printf("%s: largest error of a step %.1e\n", force.name.c_str(), worst);
    EXPECT_LT(worst, tolerance::chain_direction) << force.name;
  }
}

/// A chain of the kernels in double precision.
class KernelChain {
 public:
  KernelChain(const Chain& chain, const ChainDynamics& d) : d_(d), p_(params(d)), chain_(chain) {
    hold_.stiff_first = double(chain.stiffness_first);
    hold_.stiff_second = double(chain.stiffness_second);
    hold_.limit_first = std::cos(glm::radians(double(chain.limit_first)));
    hold_.limit_second = std::cos(glm::radians(double(chain.limit_second)));
    hold_.rest = unit(chain.rest);
    hold_.normal = unit(chain.normal);
    hold_ = k::with_theta(p_, hold_);
    state_.u = state_.w = hold_.rest;
    state_.a = state_.b = k::vec3(0, 0, 0);
    std::fill(std::begin(state_.stop), std::end(state_.stop), 0);
  }
  void step() {
    const ChainMoment moment = moments(d_, step_++, 1)[0];
    const k::real3 root = k::vec3(double(chain_.root.x), double(chain_.root.y), double(chain_.root.z));
    state_ = k::stepped(
        p_, hold_, k::pull_on(p_, moment, root, 1 / double(chain_.length), 1 / double(chain_.length), 1, 0),
        state_, 0, nullptr);
  }
  reference::State state() const {
    const auto vector = [](k::real3 v) { return glm::dvec3(v.x, v.y, v.z); };
    reference::State s;
    s.u = vector(state_.u), s.w = vector(state_.w);
    return s;
  }

 private:
  static k::real3 unit(glm::vec3 v) {
    const glm::dvec3 u = glm::normalize(glm::dvec3(v));
    return k::vec3(u.x, u.y, u.z);
  }
  ChainDynamics d_;
  ChainParams p_;
  Chain chain_;
  k::Hold hold_;
  k::Chain state_;
  long step_ = 0;
};

TEST(WeakForces, MoveTheKernelsInDoublePrecisionLikeTheReference) {
  std::vector<WeakForce> forces = weak_forces();
  for (const WeakForce& force : pressing_forces()) forces.push_back(force);
  for (const WeakForce& force : forces) {
    std::vector<KernelChain> chains;
    for (const Chain& chain : chains_under(force)) chains.emplace_back(chain, dynamics_under(force));
    int done = 0;
    expect_motion_of_reference(
        force,
        [&](int steps) {
          std::vector<reference::State> found;
          for (KernelChain& chain : chains) {
            for (int i = done; i < steps; ++i) chain.step();
            found.push_back(chain.state());
          }
          done = steps;
          return found;
        },
        force.lean > 80 || force.limit < 80);
  }
}

}  // namespace
}  // namespace pelage::strands::test
