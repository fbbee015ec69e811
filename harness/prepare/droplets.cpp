#include "harness/prepare/droplets.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "harness/picture/image_io.hpp"
#include "harness/prepare/noise.hpp"
#include "harness/prepare/random.hpp"

namespace pelage {
namespace {

/// A place on the surface, in space and in the atlas.
struct Spot {
  glm::dvec3 point;
  glm::dvec2 uv;
};

Spot spot(const Mesh& mesh, std::size_t face, glm::dvec3 bary) {
  const glm::uvec3 f = mesh.triangle[face];
  Spot s{glm::dvec3(0), glm::dvec2(0)};
  for (int c = 0; c < 3; ++c) {
    s.point += bary[c] * glm::dvec3(mesh.position[f[c]]);
    s.uv += bary[c] * glm::dvec2(mesh.uv[f[c]]);
  }
  return s;
}

/// Barycentrics of the point of triangle abc nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
template <class V>
glm::dvec3 nearest_in_triangle(V p, V a, V b, V c) {
  const V ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

template <class V, class Corner>
Spot nearest_spot(const Mesh& mesh, V p, Corner corner) {
  double least = 1e300;
  std::size_t best = 0;
  glm::dvec3 where(1, 0, 0);
  for (std::size_t f = 0; f < mesh.triangle.size(); ++f) {
    const glm::uvec3 t = mesh.triangle[f];
    const V a = corner(t.x), b = corner(t.y), c = corner(t.z);
    const glm::dvec3 bary = nearest_in_triangle(p, a, b, c);
    if (!std::isfinite(bary.x + bary.y + bary.z)) continue;  // a triangle without area
    const V d = bary.x * a + bary.y * b + bary.z * c - p;
    if (glm::dot(d, d) < least) {
      least = glm::dot(d, d);
      best = f;
      where = bary;
    }
  }
  return spot(mesh, best, where);
}

Spot place(const Mesh& mesh, const DropletScene& given) {
  if (given.point)
    return nearest_spot(mesh, glm::dvec3(*given.point),
                        [&](std::uint32_t v) { return glm::dvec3(mesh.position[v]); });
  return nearest_spot(mesh, glm::dvec2(given.uv.value_or(glm::vec2(0))),
                      [&](std::uint32_t v) { return glm::dvec2(mesh.uv[v]); });
}

/// A texel of the disc lies at most this far from its centre, in R: the disc's radius on the surface, and as
/// much again for where the atlas is stretched.
float reach(const Mesh& mesh, double radius) {
  return float(2.0 * radius * double(std::max(mesh.length_per_uv.x, mesh.length_per_uv.y)));
}

/// Points in cells of their greatest least distance, to ask whether a new one keeps clear of all.
class Crowd {
 public:
  explicit Crowd(double cell) : cell_(cell) {}
  bool clear(glm::dvec3 p, double distance) const {
    for (int k = 0; k < 27; ++k) {
      const auto found = cells_.find(key(p, k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
      if (found == cells_.end()) continue;
      for (const glm::dvec3& q : found->second)
        if (glm::distance(p, q) < distance) return false;
    }
    return true;
  }
  void add(glm::dvec3 p) { cells_[key(p, 0, 0, 0)].push_back(p); }

 private:
  std::uint64_t key(glm::dvec3 p, int dx, int dy, int dz) const {
    auto word = [&](double x, int d) {
      return std::uint64_t(std::int64_t(std::floor(x / cell_)) + d) & 0x1fffffu;
    };
    return word(p.x, dx) | word(p.y, dy) << 21 | word(p.z, dz) << 42;
  }
  double cell_;
  std::unordered_map<std::uint64_t, std::vector<glm::dvec3>> cells_;
};

/// Contiguous wet areas: smooth noise above the quantile that leaves `cover` of the surface wet.
class Patches {
 public:
  Patches(const Skin& skin, const WetnessScene& wetness)
      : size_(double(wetness.patch_size)), seed_(wetness.seed), everywhere_(wetness.patch_cover >= 1.0f) {
    if (everywhere_) return;
    std::vector<std::pair<double, double>> value;  // noise and area, per face
    double total = 0;
    for (std::size_t f = 0; f < skin.triangle.size(); ++f) {
      const glm::uvec3 t = skin.triangle[f];
      value.push_back(
          {at((skin.position[t.x] + skin.position[t.y] + skin.position[t.z]) / 3.0), skin.area[f]});
      total += skin.area[f];
    }
    std::sort(value.begin(), value.end(), std::greater<>());
    double wet = 0;
    for (const auto& [noise_value, area] : value) {
      threshold_ = noise_value;
      wet += area;
      if (wet >= double(wetness.patch_cover) * total) break;
    }
  }
  /// 0 where dry, rising to 1 within the patch.
  double depth(glm::dvec3 p) const {
    if (everywhere_) return 1;
    const double t = std::clamp((at(p) - threshold_) / 0.15, 0.0, 1.0);
    return t * t * (3 - 2 * t);
  }

 private:
  double at(glm::dvec3 p) const { return fractal_noise(p / size_, seed_ + 71u); }
  double size_;
  std::uint32_t seed_;
  bool everywhere_;
  double threshold_ = 0;
};

/// Where a picture lets droplets fall; without one, everywhere.
class Rain {
 public:
  explicit Rain(const std::filesystem::path& path) {
    if (!path.empty()) picture_ = read_picture(path);
  }
  /// Bright: at least half of white (Rec. 601 luma) in the texel under uv; the picture's top row lies at v
  /// = 1.
  bool falls(glm::dvec2 uv) const {
    if (picture_.pixel.empty()) return true;
    const int x = std::clamp(int(uv.x * picture_.width), 0, picture_.width - 1);
    const int y = std::clamp(int((1.0 - uv.y) * picture_.height), 0, picture_.height - 1);
    const glm::vec4& c = picture_.at(x, y);
    return 0.299f * c.x + 0.587f * c.y + 0.114f * c.z >= 0.5f;
  }

 private:
  Picture picture_;
};

constexpr int tries_per_droplet = 30;  // dart throwing gives up after so many misses per droplet asked for

void scatter(const Mesh& mesh, const Skin& skin, const WetnessScene& wetness, std::vector<Droplet>& out) {
  std::vector<double> below(skin.area.size() + 1, 0.0);  // cumulated area
  for (std::size_t f = 0; f < skin.area.size(); ++f) below[f + 1] = below[f] + skin.area[f];
  if (!(below.back() > 0)) return;

  const Random random(wetness.seed, 0xd20bu);
  const Patches patches(skin, wetness);
  const Rain rain(wetness.image);
  const double largest = double(wetness.radius) * (1.0 + double(wetness.radius_spread));
  const double scale = double(std::min(mesh.length_per_uv.x, mesh.length_per_uv.y));
  const double widest = std::max(1e-6, double(wetness.spacing) * largest);
  Crowd in_uv(widest), on_surface(widest * scale);

  const auto tries = std::uint64_t(wetness.random) * tries_per_droplet;
  const std::size_t wanted = out.size() + std::size_t(wetness.random);
  for (std::uint64_t i = 0; i < tries && out.size() < wanted; ++i) {
    const double pick = random.uniform(i, 0) * below.back();
    const auto face =
        std::size_t(std::upper_bound(below.begin() + 1, below.end() - 1, pick) - below.begin() - 1);
    const double s = std::sqrt(random.uniform(i, 1)), t = random.uniform(i, 2);
    const Spot here = spot(mesh, face, {1 - s, s * (1 - t), s * t});
    if (!rain.falls(here.uv)) continue;
    const double radius =
        double(wetness.radius) * (1.0 + double(wetness.radius_spread) * random.symmetric(i, 3));
    const double depth = patches.depth(here.point);
    const double rho = std::clamp(
        (double(wetness.wetness) + double(wetness.wetness_spread) * random.symmetric(i, 4)) * depth, 0.0,
        1.0);
    if (rho < 0.02) continue;
    const double apart = double(wetness.spacing) * radius;
    if (!in_uv.clear({here.uv, 0.0}, apart) || !on_surface.clear(here.point, apart * scale)) continue;
    in_uv.add({here.uv, 0.0});
    on_surface.add(here.point);
    out.push_back(
        {glm::vec2(here.uv), float(radius), float(rho), glm::vec3(here.point), reach(mesh, radius)});
  }
}

}  // namespace

std::vector<Droplet> make_droplets(const Mesh& mesh, const Skin& skin, const WetnessScene& wetness) {
  std::vector<Droplet> droplets;
  for (const DropletScene& given : wetness.droplets) {
    const Spot here = place(mesh, given);
    droplets.push_back({glm::vec2(here.uv), given.radius, given.wetness, glm::vec3(here.point),
                        reach(mesh, double(given.radius))});
  }
  scatter(mesh, skin, wetness, droplets);
  return droplets;
}

}  // namespace pelage
