// Compares chains under weak forces with the double-precision reference over 2 s: the chains of the device,
// and the kernels' equations compiled in double precision. Rounding must not stop a strand that moves in the
// reference.
#include "tests/strands/support/weak_forces.hpp"

#include "harness/compare/tolerances.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "tests/strands/support/step_errors.hpp"
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
    for (const int lanes : {1, 16}) expect_reference(force, on_device(force, lanes), false);
}

TEST(WeakForces, MoveStrandsAlongTheirStops) {
  for (const WeakForce& force : pressing_forces()) expect_reference(force, on_device(force, 0), true);
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
    state_ = k::stepped(p_, hold_, k::pull_on(p_, moment, root, 1 / double(chain_.length), 1, 0), state_, 0,
                        nullptr);
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
    expect_reference(
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
