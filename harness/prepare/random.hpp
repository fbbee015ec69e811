// Random numbers that are the same on every machine. A number depends only on the seed, the stream, the index
// of the number, and the channel.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

namespace pelage {

/// A counter-based generator of uniform numbers. It mixes bits by SplitMix64's finalizer (Steele, Lea, Flood
/// 2014).
class Random {
 public:
  constexpr Random(std::uint32_t seed, std::uint32_t stream)
      : key_(mix((std::uint64_t(seed) << 32 | stream) + golden)) {}

  /// Returns 64 random bits.
  constexpr std::uint64_t bits(std::uint64_t index, std::uint32_t channel = 0) const {
    return mix(key_ ^ mix(index * golden + channel));
  }
  /// Returns a number in [0, 1).
  constexpr double uniform(std::uint64_t index, std::uint32_t channel = 0) const {
    return double(bits(index, channel) >> 11) * 0x1p-53;
  }
  /// Returns a number in [-1, 1).
  constexpr double symmetric(std::uint64_t index, std::uint32_t channel = 0) const {
    return 2.0 * uniform(index, channel) - 1.0;
  }

 private:
  static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t key_;
};

/// Returns value noise in [-1, 1] with continuous second derivatives. Its features have a size of about one
/// unit.
double noise(glm::dvec3 p, std::uint32_t seed);

/// Returns a sum of three octaves of noise(), in [-1, 1].
double fractal_noise(glm::dvec3 p, std::uint32_t seed);

}  // namespace pelage
