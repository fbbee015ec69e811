// Strands, motions and the device that the tests in tests/strands use.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/picture/picture.hpp"
#include "harness/prepare/random.hpp"
#include "harness/strands/chain/chain.hpp"

namespace pelage::strands::test {

/// Returns a queue on the device that $PELAGE_DEVICE selects, or else on the first device.
inline const cl::Queue& queue() {
  static const cl::Queue shared(cl::choose_device(""));
  return shared;
}

inline double mean_coverage(const Picture& picture) {
  double sum = 0;
  for (const glm::vec4& pixel : picture.pixel) sum += double(pixel.w);
  return sum / double(picture.pixel.size());
}

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

}  // namespace pelage::strands::test
