// The errors of single time steps of chains on a device, compared with the double-precision reference.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <vector>

#include "harness/strands/chain/chain.hpp"
#include "harness/strands/reference/chain.hpp"

namespace pelage::strands::test {

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
  void print() const {
    std::printf("directions: 99.9%% below %.1e; rates: 99.9%% below %.1e; %.1f%% touching, %.1f%% the body\n",
                most(direction), most(rate), 100 * double(touching) / double(rate.size()),
                100 * double(in_body) / double(rate.size()));
  }
};

}  // namespace pelage::strands::test
