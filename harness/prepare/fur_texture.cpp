#include "harness/prepare/fur_texture.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/prepare/random.hpp"

namespace pelage {
namespace {

constexpr int fine = 4;               // number of sub-samples per texel and axis
constexpr double shade_unit = 127.5;  // a texel stores the shade times this number, rounded
// Painter computes the coverage c of a texel for fur of 16 layers (reference_layers). If the fur has another
// number of layers, N = fur.layers, the coverage of a layer is 1 - (1 - c)^(reference_layers / N). The N
// layers together are then as opaque as 16 layers with the coverage c.
constexpr double reference_layers = 16;

bool corrects_fragments(const FurScene& fur) {
  return fur.layer_correction == "fragment";
}

/// One slice of the texture during its generation; coverage is 0..1.
struct Slice {
  int side;
  std::vector<float> coverage, shade;
  /// Weight of the strand whose shade is stored in the texel. The weight is the strand's coverage of the
  /// texel, divided by a factor that grows with the distance between the texel and the strand's centre. Among
  /// all strands that cover the texel, the strand of greatest weight determines the stored shade.
  std::vector<float> claim;
  explicit Slice(int n)
      : side(n),
        coverage(std::size_t(n) * std::size_t(n)),
        shade(coverage.size(), 1.0f),
        claim(coverage.size()) {}
  std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(side) + std::size_t(x); }
};

int wrap(int i, int n) {
  i %= n;
  return i < 0 ? i + n : i;
}

/// The elliptic cross-section of a strand; its lengths are in texels. One semi-axis has the length
/// width * radius and the direction `across`. The other semi-axis has the length `radius`.
struct Section {
  glm::dvec2 centre, across;  ///< centre of the ellipse; direction of its longer axis (unit vector)
  double radius, width;  ///< length of the shorter semi-axis; ratio of the longer to the shorter semi-axis
};

/// Draws cross-sections of strands into a slice. The coverage of a texel by a cross-section is the fraction
/// of the texel's sub-samples inside the cross-section, times a weight. A texel stores the largest
/// coverage that any cross-section gives it.
class Painter {
 public:
  explicit Painter(Slice& slice) : slice_(slice) {}

  void paint(const Section& s, float weight, float shade) {
    // A point at the offset (dx, dy) from the centre is inside the ellipse if xx dx^2 + 2 xy dx dy + yy dy^2
    // <= 1. The following lines compute the coefficients xx, xy and yy.
    const double p = 1.0 / (s.radius * s.radius), q = p / (s.width * s.width);
    const glm::dvec2 e = s.across;
    const double xx = q * e.x * e.x + p * e.y * e.y, yy = q * e.y * e.y + p * e.x * e.x,
                 xy = (q - p) * e.x * e.y;
    const double reach_x = std::sqrt(yy / (p * q)), reach_y = std::sqrt(xx / (p * q));
    const int x0 = int(std::floor(s.centre.x - reach_x)), x1 = int(std::floor(s.centre.x + reach_x));
    const int y0 = int(std::floor(s.centre.y - reach_y)), y1 = int(std::floor(s.centre.y + reach_y));
    const int columns = x1 - x0 + 1;
    for (int y = y0; y <= y1; ++y) {
      count_.assign(std::size_t(columns), 0);
      for (int k = 0; k < fine; ++k) {
        const double dy = y + (k + 0.5) / fine - s.centre.y;
        const double square = xy * dy * xy * dy - xx * (yy * dy * dy - 1.0);
        if (square <= 0) continue;
        const double middle = s.centre.x - x0 - xy * dy / xx, half = std::sqrt(square) / xx;
        const int first = std::max(0, int(std::ceil((middle - half) * fine - 0.5)));
        const int last = std::min(columns * fine - 1, int(std::floor((middle + half) * fine - 0.5)));
        for (int i = first; i <= last; ++i) ++count_[std::size_t(i / fine)];
      }
      for (int x = x0; x <= x1; ++x) {
        const float a = weight * float(count_[std::size_t(x - x0)]) / (fine * fine);
        const std::size_t i = slice_.at(wrap(x, slice_.side), wrap(y, slice_.side));
        slice_.coverage[i] = std::max(slice_.coverage[i], a);
        const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - s.centre;
        const float claim = a / float(1.0 + xx * d.x * d.x + 2.0 * xy * d.x * d.y + yy * d.y * d.y);
        if (claim <= slice_.claim[i]) continue;
        slice_.claim[i] = claim;
        slice_.shade[i] = shade;
      }
    }
  }

 private:
  Slice& slice_;
  std::vector<int> count_;
};

/// Minimum radius of a drawn cross-section in texels. A thinner cross-section would contain too few
/// sub-samples. Such a cross-section is drawn with this radius, and its coverage is multiplied by its true
/// area divided by its drawn area.
constexpr double thinnest = 0.36;

Slice cut(const std::vector<FurStrand>& strands, const FurScene& fur, int n) {
  Slice slice(fur.texture);
  Painter painter(slice);
  const double h = (1.0 + n) / fur.layers;
  for (const FurStrand& s : strands) {
    // A slice represents the slab between itself and the slice below it. A strand that ends inside the slab
    // covers only a fraction of the slab's height.
    const double share = std::min(1.0, (s.length - h) * fur.layers + 1.0);
    if (share <= 0) continue;
    const double height = std::min(h, s.length);
    const glm::dvec2 centre = strand_centre(s, fur, height) * double(fur.texture);
    double radius = strand_radius(s, fur, height) * fur.texture, weight = share;
    if (radius < thinnest) {
      weight *= radius * radius / (thinnest * thinnest);
      radius = thinnest;
    }
    painter.paint({centre, s.across, radius, s.width}, float(weight), float(s.shade));
  }
  return slice;
}

/// Assigns shades to texels without coverage. Two passes assign the mean shade of those neighbours (8 texels
/// around the texel) that already have a shade. All remaining texels get the mean shade of the slice,
/// weighted by coverage.
void spread_shade(Slice& slice) {
  constexpr int rings = 2;
  std::vector<char> known(slice.coverage.size());
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    known[i] = slice.coverage[i] > 0;
    sum += double(slice.coverage[i]) * double(slice.shade[i]);
    weight += double(slice.coverage[i]);
  }
  const float mean = weight > 0 ? float(sum / weight) : 1.0f;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<char> before = known;
    for (int y = 0; y < slice.side; ++y)
      for (int x = 0; x < slice.side; ++x) {
        const std::size_t i = slice.at(x, y);
        if (before[i]) continue;
        float total = 0;
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const std::size_t k = slice.at(wrap(x + dx, slice.side), wrap(y + dy, slice.side));
            if (!before[k]) continue;
            total += slice.shade[k];
            ++count;
          }
        if (count == 0) continue;
        slice.shade[i] = total / float(count);
        known[i] = 1;
      }
  }
  for (std::size_t i = 0; i < known.size(); ++i)
    if (!known[i]) slice.shade[i] = mean;
}

/// Returns the next mip level: the mean coverage of 2 x 2 texels, and their mean shade weighted by coverage.
Slice half(const Slice& full) {
  Slice out(std::max(1, full.side / 2));
  for (int y = 0; y < out.side; ++y)
    for (int x = 0; x < out.side; ++x) {
      float coverage = 0, weighted = 0, plain = 0;
      for (int k = 0; k < 4; ++k) {
        const std::size_t i =
            full.at(std::min(2 * x + k % 2, full.side - 1), std::min(2 * y + k / 2, full.side - 1));
        coverage += full.coverage[i];
        weighted += full.coverage[i] * full.shade[i];
        plain += full.shade[i];
      }
      out.coverage[out.at(x, y)] = coverage / 4;
      out.shade[out.at(x, y)] = coverage > 0 ? weighted / coverage : plain / 4;
    }
  return out;
}

std::uint8_t rounded_byte(double value) {
  return std::uint8_t(std::lround(std::clamp(value, 0.0, 255.0)));
}

void store(const Slice& slice, std::vector<std::array<std::uint8_t, 2>>& texels) {
  for (std::size_t i = 0; i < slice.coverage.size(); ++i)
    texels.push_back(
        {rounded_byte(255.0 * double(slice.coverage[i])), rounded_byte(shade_unit * double(slice.shade[i]))});
}

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

double coverage_power(const FurScene& fur) {
  return corrects_fragments(fur) ? reference_layers / fur.layers : 1.0;
}

FurTexture make_fur_texture(const FurScene& fur) {
  FurTexture texture;
  texture.size = fur.texture;
  texture.layers = fur.layers;
  int levels = 1;
  while (fur.texture >> levels > 0) ++levels;
  texture.level.resize(std::size_t(levels));
  for (int l = 0; l < levels; ++l) {
    const auto side = std::size_t(fur.texture >> l);
    texture.level[std::size_t(l)].reserve(side * side * std::size_t(fur.layers));
  }

  const auto strands = grow_strands(fur);
  const double power = corrects_fragments(fur) ? 1.0 : reference_layers / fur.layers;
  for (int n = 0; n < fur.layers; ++n) {
    Slice slice = cut(strands, fur, n);
    spread_shade(slice);
    for (float& a : slice.coverage)
      if (a > 0 && a < 1) a = float(1.0 - std::pow(1.0 - double(a), power));
    store(slice, texture.level[0]);
    for (std::size_t l = 1; l < texture.level.size(); ++l) {
      slice = half(slice);
      store(slice, texture.level[l]);
    }
  }
  return texture;
}

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
