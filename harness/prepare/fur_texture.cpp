#include "harness/prepare/fur_texture.hpp"

#include <algorithm>
#include <cmath>

#include "harness/prepare/fur_strands.hpp"

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

}  // namespace pelage
