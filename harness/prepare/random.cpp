#include "harness/prepare/random.hpp"

#include <cmath>

namespace pelage {
namespace {

double lattice(const Random& random, std::int64_t x, std::int64_t y, std::int64_t z) {
  auto word = [](std::int64_t i) { return std::uint64_t(i) & 0x1fffffu; };  // 21 bits each
  return random.symmetric(word(x) | word(y) << 21 | word(z) << 42);
}

double fade(double t) {
  return t * t * t * (t * (6.0 * t - 15.0) + 10.0);
}
double lerp(double a, double b, double t) {
  return a + (b - a) * t;
}

}  // namespace

double noise(glm::dvec3 p, std::uint32_t seed) {
  const Random random(seed, 0x4e01u);
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const auto x = std::int64_t(fx), y = std::int64_t(fy), z = std::int64_t(fz);
  const double u = fade(p.x - fx), v = fade(p.y - fy), w = fade(p.z - fz);
  double plane[2];
  for (int k = 0; k < 2; ++k) {
    const double near = lerp(lattice(random, x, y, z + k), lattice(random, x + 1, y, z + k), u);
    const double far = lerp(lattice(random, x, y + 1, z + k), lattice(random, x + 1, y + 1, z + k), u);
    plane[k] = lerp(near, far, v);
  }
  return lerp(plane[0], plane[1], w);
}

double fractal_noise(glm::dvec3 p, std::uint32_t seed) {
  const double sum =
      noise(p, seed) + 0.5 * noise(2.03 * p, seed + 101u) + 0.25 * noise(4.01 * p, seed + 202u);
  return sum / 1.75;
}

}  // namespace pelage
