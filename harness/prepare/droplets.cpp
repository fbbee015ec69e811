#include "harness/prepare/droplets.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <unordered_map>
#include <utility>

#include "harness/error.hpp"
#include "harness/mesh/search.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/picture/image_module.hpp"
#include "harness/prepare/random.hpp"
#include "harness/prepare/water.hpp"

namespace pelage {
namespace {

/// The local scale of the UV map.
class UvScale {
 public:
  explicit UvScale(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)) {
    std::vector<double> area(mesh_->position.size(), 0.0), uv_area(area);
    for (const glm::uvec3& t : mesh_->triangle) {
      const glm::dvec3 a(mesh_->position[t.x]), b(mesh_->position[t.y]), c(mesh_->position[t.z]);
      const glm::dvec2 o(mesh_->uv[t.x]), d = glm::dvec2(mesh_->uv[t.y]) - o,
                                          e = glm::dvec2(mesh_->uv[t.z]) - o;
      for (int k = 0; k < 3; ++k) {
        area[t[k]] += glm::length(glm::cross(b - a, c - a));
        uv_area[t[k]] += std::abs(d.x * e.y - d.y * e.x);
      }
    }
    const double mean = std::sqrt(double(mesh_->length_per_uv.x) * double(mesh_->length_per_uv.y));
    for (std::size_t i = 0; i < area.size(); ++i)
      length_.push_back(area[i] > 0 && uv_area[i] > 0 ? std::sqrt(area[i] / uv_area[i]) : mean);
  }

  /// Returns the scale at a point of a triangle: the length on the surface, in R, per unit of UV. `weight`
  /// are the point's barycentric coordinates. At a vertex, the scale is sqrt(surface area / UV area) of the
  /// triangles around it. Between the vertices, it is interpolated linearly.
  double at(std::size_t face, glm::dvec3 weight) const {
    const glm::uvec3 t = mesh_->triangle[face];
    return weight.x * length_[t.x] + weight.y * length_[t.y] + weight.z * length_[t.z];
  }

 private:
  std::shared_ptr<const Mesh> mesh_;
  std::vector<double> length_;  ///< at each vertex of the mesh
};

/// A point of the surface: its position in space (R) and in UV, its triangle, and its barycentric
/// coordinates.
struct Spot {
  glm::dvec3 point;
  glm::dvec2 uv;
  std::size_t face;
  glm::dvec3 bary;
};

Spot spot(const Mesh& mesh, std::size_t face, glm::dvec3 bary) {
  const glm::uvec3 f = mesh.triangle[face];
  Spot s{glm::dvec3(0), glm::dvec2(0), face, bary};
  for (int c = 0; c < 3; ++c) {
    s.point += bary[c] * glm::dvec3(mesh.position[f[c]]);
    s.uv += bary[c] * glm::dvec2(mesh.uv[f[c]]);
  }
  return s;
}

/// Finds the surface points of the droplets that the scene lists (wetness.droplet). The search trees over
/// the mesh and over its UV map are each built when the first droplet needs them.
class Places {
 public:
  explicit Places(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)) {}

  Spot find(const DropletScene& given) {
    if (given.point) {
      if (!in_space_) in_space_.emplace(mesh_);
      const SurfacePlace place = in_space_->closest(*given.point);
      return spot(*mesh_, place.triangle, glm::dvec3(place.weight));
    }
    if (!in_atlas_) lay_out();
    const SurfacePlace place = in_atlas_->closest(glm::vec3(given.uv.value_or(glm::vec2(0)), 0.0f));
    return spot(*mesh_, face_[place.triangle], glm::dvec3(place.weight));
  }

 private:
  /// Builds a flat mesh from the triangles of the UV map, in the plane z = 0, and a search tree over this
  /// mesh. Triangles of zero UV area are omitted.
  void lay_out() {
    auto flat = std::make_shared<Mesh>();
    flat->uv = mesh_->uv;
    for (const glm::vec2& uv : mesh_->uv) flat->position.push_back({uv, 0.0f});
    for (std::size_t f = 0; f < mesh_->triangle.size(); ++f) {
      const glm::uvec3 t = mesh_->triangle[f];
      const glm::dvec2 o(mesh_->uv[t.x]), a = glm::dvec2(mesh_->uv[t.y]) - o,
                                          b = glm::dvec2(mesh_->uv[t.z]) - o;
      if (a.x * b.y == a.y * b.x) continue;
      flat->triangle.push_back(t);
      face_.push_back(f);
    }
    if (face_.empty())
      throw InputError(
          "wetness.droplet: the mesh's UV map has no area; give the droplet's point, not its uv");
    in_atlas_.emplace(std::move(flat));
  }

  std::shared_ptr<const Mesh> mesh_;
  std::optional<SurfaceSearch> in_space_, in_atlas_;
  std::vector<std::size_t> face_;  ///< for each triangle of the flat mesh (lay_out()), its index in mesh_
};

/// Converts the radii of the scene, which are in the unit wetness.unit.
class Radii {
 public:
  Radii(std::shared_ptr<const Mesh> mesh, const WetnessScene& wetness)
      : length_(mesh->length_per_uv), limited_(wetness.seams != "ignored") {
    if (wetness.unit == "surface") scale_.emplace(std::move(mesh));
  }
  /// Returns Droplet::radius at a place, in UV. The disc of a droplet must not be larger than the atlas.
  double in_uv(double radius, const Spot& here) const {
    return scale_ ? std::min(1.0, radius / scale_->at(here.face, here.bary)) : radius;
  }
  /// Returns Droplet::reach in R: twice the greatest radius of the droplet's disc on the surface. If u and v
  /// have different scales, the disc is an ellipse. The factor 2 allows for stretch of the UV map. Without
  /// seams, the result exceeds all distances between points of a mesh.
  float reach(double radius) const { return limited_ ? float(2.0 * radius * longest()) : 1e30f; }
  /// Returns the factor between a radius and the least radius of the droplet's disc on the surface, in R.
  double shortest() const { return double(std::min(length_.x, length_.y)) / unit(); }

 private:
  double longest() const { return double(std::max(length_.x, length_.y)) / unit(); }
  double unit() const { return scale_ ? std::sqrt(double(length_.x) * double(length_.y)) : 1.0; }

  glm::vec2 length_;
  bool limited_;
  std::optional<UvScale> scale_;
};

/// A set of points, stored in the cells of a grid. clear() tests whether a new point is at least `distance`
/// away from all stored points. The size of a grid cell must be at least `distance`.
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

/// The contiguous areas of the surface in which random droplets are placed. In these areas a smooth noise
/// exceeds a threshold. The threshold is chosen such that the noise exceeds it on the fraction `patch_cover`
/// of the surface.
class Patches {
 public:
  Patches(const Skin& skin, const WetnessScene& wetness)
      : size_(double(wetness.patch_size)), seed_(wetness.seed), everywhere_(wetness.patch_cover >= 1.0f) {
    if (everywhere_) return;
    std::vector<std::pair<double, double>> value;  // noise value and area of each face
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
  /// Returns the number by which the wetness of a droplet at p is multiplied. It is 0 outside the areas of
  /// random droplets and rises smoothly to 1 inside these areas.
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

constexpr int text_side = 2048;  // number of pixels per side of the painted wetness.text

/// The part of UV space in which wetness.image and wetness.text permit random droplets. If the scene has
/// neither of them, random droplets are permitted everywhere.
class Rain {
 public:
  explicit Rain(const WetnessScene& wetness) {
    if (!wetness.image.empty()) picture_ = read_picture(wetness.image);
    if (!wetness.text.empty())
      letters_ = paint_text({wetness.text, wetness.text_font.empty() ? default_font() : wetness.text_font,
                             double(wetness.text_u), double(wetness.text_v), double(wetness.text_height)},
                            text_side);
  }
  /// True if uv lies in a letter of the text, and the picture's pixel at uv is bright: its Rec. 601 luma is
  /// at least 0.5. The picture's top row is at v = 1.
  bool falls(glm::dvec2 uv) const {
    if (letters_ && !letters_->inside(uv.x, uv.y)) return false;
    if (picture_.pixel.empty()) return true;
    const int x = std::clamp(int(uv.x * picture_.width), 0, picture_.width - 1);
    const int y = std::clamp(int((1.0 - uv.y) * picture_.height), 0, picture_.height - 1);
    const glm::vec4& c = picture_.at(x, y);
    return 0.299f * c.x + 0.587f * c.y + 0.114f * c.z >= 0.5f;
  }

 private:
  Picture picture_;
  std::optional<TextMask> letters_;
};

constexpr int tries_per_droplet = 30;  // number of random positions that are tried per requested droplet

void scatter(const Mesh& mesh, const Skin& skin, const WetnessScene& wetness, const Radii& radii,
             std::vector<Droplet>& out) {
  std::vector<double> below(skin.area.size() + 1, 0.0);  // cumulative area of the triangles
  for (std::size_t f = 0; f < skin.area.size(); ++f) below[f + 1] = below[f] + skin.area[f];
  if (!(below.back() > 0)) return;

  const Random random(wetness.seed, 0xd20bu);
  const Patches patches(skin, wetness);
  const Rain rain(wetness);
  const double largest = double(wetness.radius) * (1.0 + double(wetness.radius_spread));
  const double scale = radii.shortest();
  const double widest = std::max(1e-6, double(wetness.spacing) * largest);
  // With radii in R, a radius in UV has no other limit than 1.
  Crowd in_uv(wetness.unit == "surface" ? std::max(1e-6, double(wetness.spacing)) : widest),
      on_surface(widest * scale);

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
    const double radius_uv = radii.in_uv(radius, here), spacing = double(wetness.spacing);
    if (!in_uv.clear({here.uv, 0.0}, spacing * radius_uv) ||
        !on_surface.clear(here.point, spacing * radius * scale))
      continue;
    in_uv.add({here.uv, 0.0});
    on_surface.add(here.point);
    out.push_back(
        {glm::vec2(here.uv), float(radius_uv), float(rho), glm::vec3(here.point), radii.reach(radius)});
  }
}

}  // namespace

std::vector<Droplet> make_droplets(const std::shared_ptr<const Mesh>& mesh, const Skin& skin,
                                   const WetnessScene& wetness) {
  std::vector<Droplet> droplets;
  Places places(mesh);
  const Radii radii(mesh, wetness);
  for (const DropletScene& given : wetness.droplets) {
    const Spot here = places.find(given);
    const double radius = double(given.radius);
    droplets.push_back({glm::vec2(here.uv), float(radii.in_uv(radius, here)), given.wetness,
                        glm::vec3(here.point), radii.reach(radius)});
    droplets.back().arrival = given.time;
  }
  const std::size_t listed = droplets.size();
  scatter(*mesh, skin, wetness, radii, droplets);
  set_arrivals(wetness, droplets, listed);
  if (wetness.seams != "joined" || droplets.empty()) return droplets;
  for (std::size_t i = 0; i < droplets.size(); ++i) droplets[i].number = std::uint32_t(i);
  return across_seams(*mesh, droplets);
}

}  // namespace pelage
