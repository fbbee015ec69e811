// Strands, motions and the device that the tests in tests/strands use, and comparisons of chains on the
// device: single time steps with the double-precision reference, energies, and bits.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/compare/tolerances.hpp"
#include "harness/picture/picture.hpp"
#include "harness/prepare/random.hpp"
#include "harness/strands/chain/chain.hpp"
#include "harness/strands/drawing/keyed.hpp"
#include "harness/strands/opencl/chains.hpp"
#include "harness/strands/reference/chain.hpp"
#include "kernels/strands/draw/params.h"
#include "tests/support/device.hpp"

namespace pelage::strands::test {

using pelage::test::queue;

/// Returns strands on a unit sphere. The stiffness of the strands varies over two decades, and their rest
/// directions lean.
inline std::vector<Chain> sphere_of(std::size_t count) {
  const Random random(7, 1);
  const auto point = [&](std::size_t i, std::uint32_t channel) {
    const double height = random.symmetric(i, channel),
                 angle = 2 * std::numbers::pi * random.uniform(i, channel + 1),
                 radius = std::sqrt(1 - height * height);
    return glm::vec3(radius * std::cos(angle), height, radius * std::sin(angle));
  };
  std::vector<Chain> chains(count);
  for (std::size_t i = 0; i < count; ++i) {
    Chain& chain = chains[i];
    chain.normal = chain.root = point(i, 0);
    const glm::vec3 side = glm::cross(point(i, 2), chain.normal);
    chain.rest = glm::normalize(chain.normal + 0.9f * side);
    chain.length = 0.05f + 0.1f * float(random.uniform(i, 4));
    chain.stiffness_first = 100 * std::pow(100.0f, float(random.uniform(i, 5)));
    chain.stiffness_second = 0.5f * chain.stiffness_first;
    chain.limit_first = 70;
    chain.limit_second = 60;
  }
  return chains;
}

/// A shaken and turning object in gusts of wind.
inline ChainDynamics shaken() {
  ChainDynamics d;
  d.wind = {.direction = {1, 0.2f, 0}, .speed = 3, .gust = 0.8f, .frequency = 1, .wavelength = 2};
  d.motion.shake = {0, 0.15f, 0.1f};
  d.motion.shake_frequency = 2;
  d.motion.axis = {0.2f, 1, 0};
  d.motion.swing = 0.8f;
  d.motion.swing_frequency = 0.5f;
  return d;
}

struct Errors {
  std::vector<double> direction, rate;
  std::size_t touching = 0, in_body = 0;

  /// Adds the errors of one strand. The unit of a rate is the square root of k1 + g / L, which is of the
  /// order of the strand's angular frequency.
  void add(const Chain& chain, const ChainState& device, const reference::State& exact) {
    direction.push_back(std::max(glm::distance(glm::dvec3(device.direction[0]), exact.u),
                                 glm::distance(glm::dvec3(device.direction[1]), exact.w)));
    const double unit = std::sqrt(double(chain.stiffness_first) + 9.81 / double(chain.length));
    rate.push_back(std::max(glm::distance(glm::dvec3(device.rate[0]), exact.a),
                            glm::distance(glm::dvec3(device.rate[1]), exact.b)) /
                   unit);
    touching += device.stop[0] + device.stop[1] + device.stop[2] + device.stop[3] > 0;
    in_body += device.body[0] + device.body[1] > 0;
  }
  /// Returns the value below which 99.9% of the errors are.
  static double most(std::vector<double> errors) {
    std::sort(errors.begin(), errors.end());
    return errors[std::size_t(0.999 * double(errors.size() - 1))];
  }
  /// Prints the errors, and expects that they are within the tolerances.
  void expect_small() const {
    std::printf("directions: 99.9%% below %.1e; rates: 99.9%% below %.1e; %.1f%% touching, %.1f%% the body\n",
                most(direction), most(rate), 100 * double(touching) / double(rate.size()),
                100 * double(in_body) / double(rate.size()));
    EXPECT_LT(most(direction), tolerance::chain_direction);
    EXPECT_LT(most(rate), tolerance::chain_rate);
  }
};

/// Simulates strands on the device, and compares 20 single steps with the reference. Each step starts from a
/// state of the device, so that errors do not accumulate. Before each of them are `pause` other steps.
inline Errors step_errors(const std::vector<Chain>& chains, const ChainDynamics& dynamics, int pause = 37) {
  Chains strands(queue(), chains, dynamics);
  Errors errors;
  for (int look = 0; look < 20; ++look) {
    strands.enqueue(queue(), pause);
    const std::vector<ChainState> before = strands.states(queue());
    const long number = strands.steps();
    strands.enqueue(queue(), 1);
    const std::vector<ChainState> after = strands.states(queue());
    for (std::size_t i = 0; i < chains.size(); ++i)
      errors.add(chains[i], after[i],
                 reference::step(chains[i], dynamics, reference::in_double(before[i]), number));
  }
  return errors;
}

/// Returns strands in the states of `strands`, without wind and motion. Changes `dynamics` likewise.
inline Chains calmed(const Chains& strands, const std::vector<Chain>& chains, ChainDynamics& dynamics) {
  dynamics.motion = {};
  dynamics.wind.speed = 0;
  Chains calm(queue(), chains, dynamics);
  calm.set(queue(), strands.states(queue()), strands.steps());
  return calm;
}

/// The largest rise of a strand's energy between two successive calls of look(), in units of k1 + m g L.
/// There is no wind and no motion.
class EnergyRise {
 public:
  void look(const std::vector<Chain>& chains, const ChainDynamics& dynamics,
            const std::vector<ChainState>& states) {
    before_.resize(chains.size(), 1e300);
    for (std::size_t i = 0; i < chains.size(); ++i) {
      const double energy = reference::energy(chains[i], dynamics, reference::in_double(states[i]), 0);
      const double unit = double(chains[i].stiffness_first) + 9.81 / double(chains[i].length);
      largest_ = std::max(largest_, (energy - before_[i]) / unit);
      before_[i] = energy;
    }
  }
  double largest() const { return largest_; }

 private:
  std::vector<double> before_;
  double largest_ = 0;
};

/// Returns the part of the strands whose tips move by more than 0.01 L/s.
inline double moving_part(const ChainDynamics& dynamics, const std::vector<ChainState>& states) {
  const double l1 = double(dynamics.first_segment), l2 = 1 - l1;
  const auto moving = std::count_if(states.begin(), states.end(), [&](const ChainState& s) {
    return glm::length(l1 * glm::dvec3(s.rate[0]) + l2 * glm::dvec3(s.rate[1])) > 0.01;
  });
  std::printf("%td of %zu tips move\n", moving, states.size());
  return double(moving) / double(states.size());
}

/// Returns the number of strands whose states have different bits.
inline std::size_t different(const std::vector<ChainState>& a, const std::vector<ChainState>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    count += a[i].direction != b[i].direction || a[i].rate != b[i].rate || a[i].stop != b[i].stop ||
             a[i].body != b[i].body;
  return count;
}

/// Returns the present key strands of chains.
inline std::vector<KeyStrand> written_keys(Chains& strands, std::size_t count) {
  const cl::Buffer<float> keys(queue().device(), (count + 15) / 16 * 16 * KEY_RECORD);
  strands.write_keys(queue(), keys);
  return keys_of(keys.read(queue()), count);
}

}  // namespace pelage::strands::test
