#include "harness/shells/reference/mask.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "harness/parallel.hpp"
#include "harness/prepare/water.hpp"
#include "harness/shells/reference/layers.hpp"

namespace pelage::reference {
namespace {

/// Returns the index, along one axis of the mask, of the texel that contains the texture coordinate u. The
/// mask repeats with period 1. If u is NaN, the function returns 0, so the index is always inside the mask.
int repeated(double u, int size) {
  const double inside = u - std::floor(u);
  return inside >= 0.0 ? std::min(int(inside * double(size)), size - 1) : 0;
}

Clump weighted(const Clump& a, const Clump& b, double t) {
  return {(1.0 - t) * a.centre + t * b.centre, (1.0 - t) * a.radius + t * b.radius,
          (1.0 - t) * a.wetness + t * b.wetness};
}

/// With clump.cells "consistent", a droplet touches texels whose centres are at most this far outside its
/// disc, in UV units: half of a texel's diagonal and the width of the ring.
double rim(const Scene& scene) {
  return scene.clump.cells == "consistent" ? (std::sqrt(0.5) + 0.5) / double(scene.wetness.size) : 0.0;
}

/// Calls change(texel) for the numbers of all texels that a droplet covers (docs/shells.md, section 2). The
/// droplet covers a texel if two distances are small enough. The distance in UV from the texel's centre to
/// the droplet's centre must be at most droplet.radius. The distance from the texel's surface point to
/// droplet.point must be at most droplet.reach.
///
/// With clump.cells "consistent", the droplet also touches texels whose centres are up to rim() outside the
/// disc. The second argument of `change` is the distance in UV from the disc's centre to the texel's centre,
/// divided by the radius of the disc.
template <class Change>
void for_each_covered(const FrameInput& input, const Droplet& droplet, const Change& change) {
  const int size = input.scene.wetness.size;
  const double more = rim(input.scene);
  // `first` and `last` compute the range of texel rows or columns that the droplet's disc can touch, plus one
  // texel on either side. `c` is the coordinate of the disc's centre.
  const auto first = [&](float c) {
    return std::clamp(int(std::floor(double(c - droplet.radius) * double(size))) - 1, 0, size);
  };
  const auto last = [&](float c) {
    return std::clamp(int(std::ceil(double(c + droplet.radius) * double(size))) + 1, 0, size);
  };
  for (int j = first(droplet.centre.y); j < last(droplet.centre.y); ++j)
    for (int i = first(droplet.centre.x); i < last(droplet.centre.x); ++i) {
      const glm::dvec2 centre((double(i) + 0.5) / double(size), (double(j) + 0.5) / double(size));
      const double distance = glm::length(centre - glm::dvec2(droplet.centre));
      if (distance > double(droplet.radius) + more) continue;
      const std::size_t at = std::size_t(j) * std::size_t(size) + std::size_t(i);
      if (glm::length(glm::dvec3(input.mask_surface[at]) - glm::dvec3(droplet.point)) > double(droplet.reach))
        continue;
      change(at, distance / double(droplet.radius));
    }
}

/// Returns the droplets in the order in which they are blended into the mask: with clump.cells "consistent"
/// the wettest first, else as given.
std::vector<Droplet> in_order(const FrameInput& input, int frames) {
  std::vector<Droplet> droplets =
      droplets_at(input.scene.wetness, input.droplets, picture_time(input.scene.dynamics, frames));
  if (input.scene.clump.cells == "consistent")
    std::stable_sort(droplets.begin(), droplets.end(),
                     [](const Droplet& a, const Droplet& b) { return a.wetness > b.wetness; });
  return droplets;
}

/// Calls apply(texel, droplet, inside) for each texel that a droplet or one of its repetitions touches, in
/// the order of blending. If several of them touch a texel, apply() receives the one whose centre is nearest
/// to the texel's centre, measured in radii of its disc. `inside` is true if the disc contains the texel's
/// centre.
template <class Apply>
void for_each_blended(const FrameInput& input, const std::vector<Droplet>& droplets, const Apply& apply) {
  struct Nearest {
    double radii;
    const Droplet* droplet;
  };
  for (std::size_t first = 0, next; first < droplets.size(); first = next) {
    std::map<std::size_t, Nearest> touched;
    for (next = first; next == first || (next < droplets.size() && droplets[first].number != Droplet::alone &&
                                         droplets[next].number == droplets[first].number);
         ++next)
      for_each_covered(input, droplets[next], [&](std::size_t at, double radii) {
        const auto [known, is_new] = touched.try_emplace(at, Nearest{radii, &droplets[next]});
        if (!is_new && radii < known->second.radii) known->second = {radii, &droplets[next]};
      });
    for (const auto& [at, nearest] : touched) apply(at, *nearest.droplet, nearest.radii <= 1.0);
  }
}

}  // namespace

bool is_blended(const Clump& texel, const Droplet& droplet, const std::string& way) {
  if (texel.wetness == 0.0) return false;
  return way == "overlap" || glm::length(texel.centre - glm::dvec2(droplet.centre)) <= double(droplet.radius);
}

Clump blend(const Clump& texel, const Droplet& droplet, const std::string& way, double margin) {
  const glm::dvec2 centre(droplet.centre);
  const double radius = double(droplet.radius), wetness = double(droplet.wetness);
  if (!is_blended(texel, droplet, way)) return {centre, radius, wetness};
  Clump result = texel;
  result.wetness = std::clamp(texel.wetness + wetness, 0.0, 1.0);
  if (result.wetness != 0.0) {
    const double alpha = wetness / result.wetness;
    result.centre = (1.0 - alpha) * texel.centre + alpha * centre;
    result.radius = (1.0 - alpha) * texel.radius + alpha * radius + 4.0 * alpha * (1.0 - alpha) * margin;
  }
  return result;
}

Clump applied(const Clump& texel, const Droplet& droplet, bool inside, const Scene& scene) {
  if (inside)
    return blend(texel, droplet, scene.wetness.blend,
                 scene.clump.cells == "consistent" ? std::sqrt(0.5) / double(scene.wetness.size) : 0.0);
  if (texel.wetness > 0.0) return texel;
  return {glm::dvec2(droplet.centre), double(droplet.radius), double(droplet.wetness)};
}

Clump Mask::wet_at(const glm::dvec2& uv, const std::string& cells) const {
  const Clump clump = nearest(uv);
  if (cells == "consistent" && glm::length(uv - clump.centre) > clump.radius) return {};
  return clump;
}

double Mask::wetness_at(const glm::dvec2& uv, const std::string& cells) const {
  const Clump clump = nearest(uv);
  return cells == "consistent" ? clump.wetness * ring_share(clump, uv) : clump.wetness;
}

glm::dvec2 Mask::cell(const Clump& clump) const {
  return glm::floor(64.0 * double(size) * clump.centre);
}

double Mask::ring_share(const Clump& clump, const glm::dvec2& uv) const {
  const double depth = clump.radius - glm::length(uv - clump.centre), width = 0.5 / double(size);
  return std::clamp(1.0 + depth / width, 0.0, 1.0);
}

const Clump& Mask::nearest(const glm::dvec2& uv) const {
  return texel[std::size_t(repeated(uv.y, size)) * std::size_t(size) + std::size_t(repeated(uv.x, size))];
}

Clump Mask::bilinear(const glm::dvec2& uv) const {
  const double side = double(size);
  const glm::dvec2 corner(std::floor(uv.x * side - 0.5), std::floor(uv.y * side - 0.5));
  const glm::dvec2 part(uv.x * side - 0.5 - corner.x, uv.y * side - 0.5 - corner.y);
  const auto at = [&](double i, double j) {
    return nearest({(corner.x + i + 0.5) / side, (corner.y + j + 0.5) / side});
  };
  return weighted(weighted(at(0, 0), at(1, 0), part.x), weighted(at(0, 1), at(1, 1), part.x), part.y);
}

Mask wetness_mask(const FrameInput& input, int frames, Mutant mutant) {
  Mask mask{input.scene.wetness.size, {}};
  mask.texel.resize(std::size_t(mask.size) * std::size_t(mask.size));
  std::vector<Droplet> droplets = in_order(input, frames);
  if (mutant == Mutant::droplets_reversed) std::reverse(droplets.begin(), droplets.end());
  for_each_blended(input, droplets, [&](std::size_t at, const Droplet& droplet, bool inside) {
    mask.texel[at] = applied(mask.texel[at], droplet, inside, input.scene);
  });
  return mask;
}

double blended_share(const FrameInput& input, int frames) {
  const std::size_t side = std::size_t(input.scene.wetness.size);
  std::vector<Clump> texels(side * side);
  std::vector<std::uint8_t> blended(texels.size(), 0);
  for_each_blended(input, in_order(input, frames), [&](std::size_t at, const Droplet& droplet, bool inside) {
    if (inside) blended[at] = std::uint8_t(is_blended(texels[at], droplet, input.scene.wetness.blend));
    texels[at] = applied(texels[at], droplet, inside, input.scene);
  });
  double wet = 0, mixed = 0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    if (texels[i].wetness == 0.0) continue;
    ++wet;
    mixed += blended[i];
  }
  return wet > 0 ? mixed / wet : 0;
}

namespace {

/// The displacement of a point p by a clump, in a layer with the factor f of S Eq. 5.
struct ClumpReading {
  std::string scale;  ///< clump.scale
  double gain = 0;    ///< clump.gain
  Clump clump;

  /// rho f, limited to .98: the share of its distance from the centre by which a strand leans
  double share(double f) const { return std::min(clump.wetness * f, 0.98); }
  /// Returns d, in UV units.
  glm::dvec2 displacement(double f, const glm::dvec2& p) const {
    const glm::dvec2 away = p - clump.centre;
    const double distance = glm::length(away);
    if (scale == "converge") return share(f) / (1.0 - share(f)) * away;
    if (scale == "distance")
      return distance > 0.0 ? f * clump.wetness * clump.radius * away / distance : away;
    return f * clump.wetness * clump.radius * gain * away;
  }
  /// Returns the point p at which the strand with the root q is drawn: p + displacement(f, p) = q. With
  /// "distance", q is further from the centre than the strand moves.
  glm::dvec2 drawn(double f, const glm::dvec2& q) const {
    const glm::dvec2 away = q - clump.centre;
    const double distance = glm::length(away);
    if (scale == "converge") return clump.centre + (1.0 - share(f)) * away;
    if (scale == "distance")
      return distance > 0.0 ? q - f * clump.wetness * clump.radius * away / distance : q;
    return clump.centre + away / (1.0 + f * clump.wetness * clump.radius * gain);
  }
  double stretch(double f) const { return scale == "converge" ? 1.0 / (1.0 - share(f)) : 1.0; }
};

ClumpReading unsoaked_reading(const ClumpScene& scene, const Clump& clump) {
  return {scene.scale, double(scene.gain), clump};
}

/// Returns the displacement by a clump. In soaked fur, clumps disappear.
ClumpReading clump_reading(const Scene& scene, Clump clump) {
  clump.wetness *= 1.0 - soaked_share(scene.soaked, clump.wetness);
  return unsoaked_reading(scene.clump, clump);
}

}  // namespace

double clump_shape(double h, double w, int layers, std::string_view function, Mutant mutant) {
  if (function == "rate") {
    // A hair has three segments. Its vertices at 1/3, 2/3 and 1 move by h + w (1-h), and its root does not
    // move.
    const double third = std::min(std::floor(3.0 * h), 2.0) / 3.0, part = 3.0 * (h - third);
    const auto vertex = [&](double v) { return v > 0.0 ? v + w * (1.0 - v) : 0.0; };
    return (1.0 - part) * vertex(third) + part * vertex(third + 1.0 / 3.0);
  }
  const double k = (mutant == Mutant::log_negated ? -1.0 : 1.0) * std::log(double(layers));
  // The maximum avoids ln 0, because h is 0 on the first layer with Mutant::height_without_one.
  return (1.0 - w) * h + w * (1.0 + std::log(std::max(h, 1e-9)) / k);
}

glm::dvec2 drawn_at(const Scene& scene, const Clump& clump, double f, const glm::dvec2& root) {
  return clump_reading(scene, clump).drawn(f, root);
}

namespace {

/// Calls use(clump, weight) for the clumps of the four texels around uv, with their bilinear weights.
template <class Use>
void for_four(const Mask& mask, const glm::dvec2& uv, const Use& use) {
  const double side = double(mask.size);
  const glm::dvec2 corner = glm::floor(uv * side - 0.5), part = uv * side - 0.5 - corner;
  for (const double j : {0.0, 1.0})
    for (const double i : {0.0, 1.0})
      use(mask.nearest((corner + glm::dvec2(i, j) + 0.5) / side),
          (i > 0 ? part.x : 1.0 - part.x) * (j > 0 ? part.y : 1.0 - part.y));
}

/// Returns where the clumps of the four texels around `root` draw the strand of this root, relative to the
/// fragment at `uv`. A clump draws it displaced with the weight ring_share(), and else where its root is.
std::vector<Placement> placements(const Scene& scene, const Mask& mask, double f, const glm::dvec2& root,
                                  const glm::dvec2& uv) {
  std::vector<Placement> found;
  double unmoved = 0.0;
  for_four(mask, root, [&](const Clump& clump, double weight) {
    const double share = mask.ring_share(clump, root);
    found.push_back({weight * share, clump_reading(scene, clump).drawn(f, root) - uv});
    unmoved += weight * (1.0 - share);
  });
  found.push_back({unmoved, root - uv});
  return found;
}

/// Sets the film of soaked fur at `uv`: the part of the surface that it covers, and its wetness.
void find_film(const Scene& scene, const Mask& mask, const glm::dvec2& uv, Displacement& result) {
  for_four(mask, uv, [&](const Clump& clump, double weight) {
    const double part = weight * mask.ring_share(clump, uv);
    result.film += part * soaked_share(scene.soaked, clump.wetness);
    result.film_wetness += part * clump.wetness;
  });
}

}  // namespace

Displacement clump_displacement(const FrameInput& input, const Mask& mask, const glm::dvec2& uv, int n,
                                Mutant mutant) {
  const ClumpScene& scene = input.scene.clump;
  const int layers = input.scene.fur.layers;
  const auto look = [&](const glm::dvec2& at) {
    return mutant == Mutant::mask_bilinear ? mask.bilinear(at) : mask.wet_at(at, scene.cells);
  };
  Displacement result;
  const Clump here = look(uv);
  result.wetness = here.wetness;
  const Clump& texel = mask.nearest(uv);
  if (!(texel.wetness > 0.0)) return result;

  const auto f = [&](int layer) {
    if (layer < 0) return 0.0;
    return clump_shape(layer_height(layer, layers, mutant), double(scene.shape), layers, scene.function,
                       mutant);
  };
  const ClumpReading reading = clump_reading(input.scene, here);
  const glm::dvec2 root = uv + reading.displacement(f(n), uv);
  result.d = root - uv;
  result.delta_d = result.d - reading.displacement(f(n - 1), uv);
  result.moved = reading.drawn(f(n), root) - reading.drawn(f(n - 1), root);
  result.stretch = reading.stretch(f(n));

  if (scene.cells == "consistent") {
    result.placements = placements(input.scene, mask, f(n), root, uv);
    // Without the film: the wetness of the strands' light jumps at the border also in soaked fur.
    result.border_d = unsoaked_reading(scene, texel).displacement(f(n), uv);
    find_film(input.scene, mask, uv, result);
    result.border_distance = std::abs(texel.radius - glm::length(uv - texel.centre));
    return result;
  }
  const Clump there = look(root);
  result.outside = glm::length(uv - here.centre) > here.radius;
  result.dry = !(there.wetness > 0.0);
  result.discarded =
      result.outside || result.dry || (scene.cells == "separate" && mask.cell(there) != mask.cell(here));
  return result;
}

Discards discards(const FrameInput& input, int frames, std::size_t most) {
  const Mask mask = wetness_mask(input, frames);
  const int layers = input.scene.fur.layers;
  std::vector<Discards> row(std::size_t(mask.size));
  std::vector<double> wet(row.size());
  // Each row of texels has four positions in each texel, in all layers. Of these, every `step`-th is visited,
  // beginning with another one in each row. The step is odd, so that all layers have their turn.
  const std::size_t in_row = 4 * std::size_t(mask.size) * std::size_t(layers);
  const std::size_t step = in_row * row.size() / most | 1;
  for_each_index(row.size(), 4, [&](std::size_t j) {
    for (std::size_t m = 7919 * j % step; m < in_row; m += step) {
      const int i = int(m / std::size_t(layers));
      const glm::dvec2 in_texel(.25 + .5 * (i % 2), .25 + .5 * (i / 2 % 2));
      const glm::dvec2 uv = (glm::dvec2(i / 4, double(j)) + in_texel) / double(mask.size);
      if (!(mask.nearest(uv).wetness > 0.0)) continue;
      const Displacement found = clump_displacement(input, mask, uv, int(m % std::size_t(layers)));
      ++wet[j];
      row[j].outside += found.outside;
      row[j].dry += found.dry && !found.outside;
    }
  });
  Discards all;
  double fragments = 0;
  for (std::size_t j = 0; j < row.size(); ++j) {
    all.outside += row[j].outside;
    all.dry += row[j].dry;
    fragments += wet[j];
  }
  return fragments > 0 ? Discards{all.outside / fragments, all.dry / fragments} : all;
}

double soaked_share(const SoakedScene& soaked, double rho) {
  const double threshold = double(soaked.threshold);
  if (threshold >= 1.0) return 0.0;
  const double x = std::clamp((rho - threshold) / (1.0 - threshold), 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

double film_coverage(const Scene& scene, double h) {
  return std::clamp((double(scene.soaked.height) - h) * double(scene.fur.layers) + 1.0, 0.0, 1.0);
}

double cover_with_film(FurSample& fur, double share, double coverage) {
  if (share == 0.0) return 0.0;
  const double strands = (1.0 - share) * fur.coverage, film = share * coverage;
  fur.coverage = strands + film;
  if (!(fur.coverage > 0.0)) return 0.0;
  fur.shade = (strands > 0.0 ? strands * fur.shade : 0.0) / fur.coverage + film / fur.coverage;
  return film / fur.coverage;
}

}  // namespace pelage::reference
