#include "harness/prepare/fur_strands.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/prepare/random.hpp"

namespace pelage {
namespace {

enum Stream : std::uint32_t {
  guard_roots = 1,
  undercoat_roots,
  lock_centres,
  lock_traits,
  guard_traits,
  undercoat_traits
};

// The random variation of a hair's shade is a weighted sum of two random values. One value is common to all
// hairs of a lock and has the weight lock_share. The other value belongs to the hair alone.
constexpr double lock_share = 0.4;
constexpr double undercoat_thinness = 0.8;  // ratio of an undercoat hair's radius to a guard hair's radius

glm::dvec2 shortest(glm::dvec2 d) {
  return d - glm::round(d);
}

/// Returns the index of the lock centre nearest to `point`. Distances wrap around the unit square.
std::size_t nearest(const std::vector<glm::dvec2>& centres, glm::dvec2 point) {
  std::size_t best = 0;
  double least = 1e30;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const glm::dvec2 d = shortest(centres[i] - point);
    const double square = glm::dot(d, d);
    if (square < least) {
      least = square;
      best = i;
    }
  }
  return best;
}

}  // namespace

std::vector<glm::dvec2> jittered_points(int count, std::uint32_t seed, std::uint32_t stream) {
  std::vector<glm::dvec2> points;
  points.reserve(std::size_t(std::max(count, 0)));
  const Random random(seed, stream);
  const int rows = std::max(1, int(std::lround(std::sqrt(double(std::max(count, 0))))));
  for (int j = 0; j < rows; ++j) {
    const int first = int(std::int64_t(count) * j / rows), last = int(std::int64_t(count) * (j + 1) / rows);
    for (int i = first; i < last; ++i) {
      const double x = (i - first + random.uniform(std::uint64_t(i), 0)) / (last - first);
      points.push_back({x, (j + random.uniform(std::uint64_t(i), 1)) / rows});
    }
  }
  return points;
}

std::vector<FurStrand> grow_strands(const FurScene& fur) {
  const auto centres = jittered_points(fur.locks, fur.seed, lock_centres);
  const Random lock(fur.seed, lock_traits);
  std::vector<FurStrand> strands;
  strands.reserve(std::size_t(fur.strands) + std::size_t(fur.undercoat));

  auto grow = [&](int count, std::uint32_t roots, std::uint32_t traits, bool guard) {
    const Random random(fur.seed, traits);
    const auto points = jittered_points(count, fur.seed, roots);
    for (std::size_t i = 0; i < points.size(); ++i) {
      FurStrand s;
      s.root = points[i];
      const double least = double(fur.least_length);
      s.length = least + (1.0 - least) * std::pow(random.uniform(i, 0), 0.7);
      if (!guard) s.length *= double(fur.undercoat_length);
      s.length = std::max(s.length, 1e-4);
      s.radius = double(fur.radius) / 256.0 * (0.75 + 0.5 * random.uniform(i, 1)) *
                 (guard ? 1.0 : undercoat_thinness);
      double tone = random.symmetric(i, 2);
      if (!centres.empty()) {
        const std::size_t k = nearest(centres, s.root);
        s.pull = double(fur.lock_pull) * shortest(centres[k] - s.root);
        tone = lock_share * lock.symmetric(k) + (1.0 - lock_share) * tone;
      }
      s.shade = 1.0 + double(fur.shade) * tone;
      const double azimuth = 2.0 * std::numbers::pi * random.uniform(i, 3);
      const glm::dvec2 along(std::cos(azimuth), std::sin(azimuth));
      s.width = guard ? double(fur.width) : 1.0;
      s.across = {-along.y, along.x};
      s.bend = double(fur.bend) / 256.0 * (0.5 + random.uniform(i, 4)) * s.length * along;
      s.steep = double(fur.bend_exponent) * (1.0 + double(fur.bend_spread) * random.symmetric(i, 5));
      strands.push_back(s);
    }
  };
  grow(fur.strands, guard_roots, guard_traits, true);
  grow(fur.undercoat, undercoat_roots, undercoat_traits, false);
  return strands;
}

glm::dvec2 strand_centre(const FurStrand& s, const FurScene& fur, double h) {
  glm::dvec2 centre = s.root + s.pull * std::pow(h, double(fur.lock_power));
  if (fur.bend != 0.0f) {
    const double t = std::min(h / s.length, 1.0);
    centre += s.bend * (std::expm1(s.steep * t) / std::expm1(s.steep));
  }
  return centre;
}

double strand_radius(const FurStrand& s, const FurScene& fur, double h) {
  const double t = std::min(h / s.length, 1.0);
  const double radius = s.radius * (1.0 - (1.0 - double(fur.tip_radius)) * std::pow(t, double(fur.taper)));
  // Distance between two neighbouring slices of the texture, as a fraction of the side of the texture's
  // square.
  const double spacing = double(fur.length) * double(fur.tile) / fur.layers;
  return std::sqrt(radius * radius + 2.0 * radius * spacing * double(fur.sweep) / std::numbers::pi);
}

}  // namespace pelage
