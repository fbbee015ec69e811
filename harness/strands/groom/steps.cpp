#include "harness/strands/groom/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <unordered_map>

#include "harness/error.hpp"
#include "harness/prepare/strands.hpp"

namespace pelage::strands {
namespace {

constexpr std::uint32_t none = 0xffffffff;
// A direction of the comb map below this length is taken for grey. Grey of 8 bits has at most the length
// sqrt(3) / 255.
constexpr double least_direction = 1.0 / 32;
constexpr double least_cosine = 1e-6;                    // keeps the rounded direction at rest above the skin
constexpr float least_length = 1e-4f, most_length = 10;  // R, the limits of Chain::length

/// Returns the direction that leans from the normal n by `angle` (radians) towards the projection of `comb`
/// onto the surface. Returns n if the projection is 0.
glm::dvec3 leaning(glm::dvec3 n, glm::dvec3 comb, double angle) {
  const glm::dvec3 flat = tangential(comb, n);
  const double length = glm::length(flat);
  if (length < 1e-6 * glm::length(comb) || length == 0) return n;
  return std::max(std::cos(angle), least_cosine) * n + std::sin(angle) / length * flat;
}

/// The comb map's direction at a vertex, in the object's frame. Its length is that of the map's vector.
glm::dvec3 combed(const PictureMap& comb, const SurfaceTangents& tangents, glm::dvec3 n, glm::dvec2 uv,
                  std::size_t vertex) {
  const glm::dvec4 colour(comb.at(uv));
  const auto unit = [](glm::dvec3 v) { return glm::length(v) > 0 ? glm::normalize(v) : v; };
  return (2 * colour.x - 1) * unit(tangential(glm::dvec3(tangents.t[vertex]), n)) +
         (2 * colour.y - 1) * unit(tangential(glm::dvec3(tangents.b[vertex]), n)) + (2 * colour.z - 1) * n;
}

/// The mean values of a surface point's copies.
struct Point {
  double length = 0, stiffness = 0;
  glm::dvec3 comb{0};
  glm::dvec2 uv{0};  ///< UV of one of the copies
  int copies = 0;
};

}  // namespace

KeyStrands key_strands(const Mesh& mesh, const Skin& skin, const LayerMaps& maps,
                       const std::vector<Root>& roots) {
  KeyStrands result;
  result.index.assign(mesh.welded, none);
  for (const Root& root : roots)
    for (int corner = 0; corner < 3; ++corner) result.index[mesh.weld[mesh.triangle[root.face][corner]]] = 0;
  std::vector<Point> points(mesh.welded);
  const SurfaceTangents tangents = maps.comb ? surface_tangents(mesh, skin) : SurfaceTangents{};
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    if (result.index[mesh.weld[v]] == none) continue;
    Point& point = points[mesh.weld[v]];
    const glm::dvec2 uv(mesh.uv[v]);
    point.length += maps.length.at(uv);
    point.stiffness += maps.stiffness.at(uv);
    if (maps.comb) point.comb += combed(*maps.comb, tangents, skin.normal[mesh.weld[v]], uv, v);
    point.uv = uv;
    ++point.copies;
  }
  const StrandLayerScene& layer = maps.layer;
  const double lean = double(layer.lean) * std::numbers::pi / 180;
  for (std::uint32_t w = 0; w < mesh.welded; ++w) {
    if (result.index[w] == none) continue;
    result.index[w] = std::uint32_t(result.keys.size());
    const Point& point = points[w];
    const glm::dvec3 n = skin.normal[w];
    glm::dvec3 comb(layer.comb);
    double angle = lean;
    if (maps.comb) {
      comb = point.comb / double(point.copies);
      const double length = glm::length(comb), upright = std::clamp(glm::dot(comb, n) / length, 0.0, 1.0);
      if (!(length > least_direction) || glm::dot(comb, n) < -0.999 * length)
        throw InputError(fmt::format(
            "{}.comb_map: {}: the direction at UV ({:.3f}, {:.3f}) is zero or points into the skin, but the layer has strands there",
            maps.name, layer.comb_map.string(), point.uv.x, point.uv.y));
      angle = lean * std::acos(upright) / (std::numbers::pi / 2);
    }
    KeyStrand key;
    key.root = glm::vec3(skin.position[w]);
    key.normal = glm::vec3(n);
    key.first = key.second = key.rest = glm::vec3(glm::normalize(leaning(n, comb, angle)));
    result.keys.push_back(key);
    Chain chain;
    chain.root = key.root;
    chain.rest = key.rest;
    chain.normal = key.normal;
    chain.length =
        std::clamp(float(double(layer.length) * point.length / point.copies), least_length, most_length);
    chain.stiffness_first = chain.stiffness_second =
        float(double(layer.stiffness) * point.stiffness / point.copies);
    chain.drag = layer.drag;
    chain.damping = layer.damping;
    chain.limit_first = chain.limit_second = layer.limit;
    result.chains.push_back(chain);
    result.point.push_back(w);
  }
  return result;
}

namespace {

using Vec = glm::dvec3;

constexpr double radian = std::numbers::pi / 180;
constexpr double least_lean = 1e-3;  // radians; the twist of a strand that leans less has no effect
constexpr double shortest = 0.5, longest = 1.25;  // limits of the change of a strand's length
constexpr int most_rings = 6;  // cells from a strand's root within which the middle of a lock is searched

/// A strand at rest without twist and curvature.
struct Straight {
  Vec root{0}, normal{0}, rest{0};
};

Straight straight(const KeyedStrand& s, const std::vector<KeyStrand>& keys) {
  const auto mean = [&](glm::vec3 KeyStrand::*v) {
    const Vec a(keys[s.key[0]].*v), b(keys[s.key[1]].*v), c(keys[s.key[2]].*v);
    return a + double(s.weight.x) * (b - a) + double(s.weight.y) * (c - a);
  };
  return {mean(&KeyStrand::root), glm::normalize(mean(&KeyStrand::normal)),
          glm::normalize(mean(&KeyStrand::rest))};
}

Vec turned(Vec v, Vec axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
         (1 - std::cos(angle)) * glm::dot(axis, v) * axis;
}

/// Returns the vector from the root to the tip, in lengths of the strand.
Vec reach(const Straight& at, const KeyedStrand& s, double first) {
  const Vec u = turned(at.rest, at.normal, double(s.twist) * radian);
  const Vec across = glm::cross(at.normal, u);
  const double sine = glm::length(across);
  const Vec w = sine > 1e-9 ? turned(u, across / sine, double(s.curvature) * radian) : u;
  return first * u + (1 - first) * w;
}

/// Sets twist, curvature and length so that the tip is at root + `wanted`, as far as the limits allow.
void aim(KeyedStrand& s, const Straight& at, Vec wanted, double first) {
  const double up = glm::dot(wanted, at.normal),
               lean = std::acos(std::clamp(glm::dot(at.rest, at.normal), -1.0, 1.0));
  const Vec flat = wanted - up * at.normal, side = at.rest - glm::dot(at.rest, at.normal) * at.normal;
  if (lean < least_lean || glm::length(flat) < 1e-9) return;
  s.twist = float(std::atan2(glm::dot(glm::cross(side, flat), at.normal), glm::dot(side, flat)) / radian);
  // The chord of the two segments leans by `bend` more than the first segment.
  const double bend = std::atan2(glm::length(flat), up) - lean;
  const double further = std::asin(std::clamp(first / (1 - first) * std::sin(bend), -1.0, 1.0));
  s.curvature = float(std::clamp((bend + further) / radian, -180.0, 180.0));
  const double length = glm::length(wanted) / glm::length(reach(at, s, first));
  s.length = float(std::clamp(length, shortest * double(s.length), longest * double(s.length)));
}

/// The roots of the middles, in a grid of cells.
class Middles {
 public:
  Middles(const std::vector<Straight>& at, std::size_t count, double cell) : at_(at), cell_(cell) {
    for (std::size_t i = 0; i < count; ++i) cells_[key_of(cell_of(at[i].root))].push_back(i);
  }

  /// Returns the middle with the nearest root on the same side of the skin, or `i` if none is near.
  std::size_t nearest(std::size_t i) const {
    const glm::ivec3 here = cell_of(at_[i].root);
    std::size_t found = i;
    double least = most_rings * cell_;
    for (int ring = 0; ring <= most_rings && least > (ring - 1) * cell_; ++ring)
      for (int x = -ring; x <= ring; ++x)
        for (int y = -ring; y <= ring; ++y)
          for (int z = -ring; z <= ring; ++z) {
            if (std::max({std::abs(x), std::abs(y), std::abs(z)}) < ring) continue;
            const auto cell = cells_.find(key_of(here + glm::ivec3(x, y, z)));
            if (cell == cells_.end()) continue;
            for (const std::size_t middle : cell->second) {
              const double distance = glm::distance(at_[middle].root, at_[i].root);
              if (distance < least && glm::dot(at_[middle].normal, at_[i].normal) > 0) {
                least = distance;
                found = middle;
              }
            }
          }
    return found;
  }

 private:
  glm::ivec3 cell_of(Vec p) const { return glm::ivec3(glm::floor(p / cell_)); }
  static std::uint64_t key_of(glm::ivec3 c) {
    const auto word = [](int v) { return std::uint64_t(std::uint32_t(v) & 0x1fffffu); };
    return word(c.x) | word(c.y) << 21 | word(c.z) << 42;
  }
  const std::vector<Straight>& at_;
  double cell_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

}  // namespace

void pull_into_locks(std::span<KeyedStrand> strands, const std::vector<KeyStrand>& keys,
                     const LockOptions& options) {
  const std::size_t locks = std::min(options.locks, strands.size());
  if (locks == 0 || options.pull == 0) return;
  const double first = double(options.first_segment), pull = double(options.pull);
  std::vector<Straight> at;
  Vec low(1e30), high(-1e30);
  for (const KeyedStrand& s : strands) {
    at.push_back(straight(s, keys));
    low = glm::min(low, at.back().root);
    high = glm::max(high, at.back().root);
  }
  std::vector<Vec> tips;
  for (std::size_t i = 0; i < strands.size(); ++i)
    tips.push_back(at[i].root + double(strands[i].length) * reach(at[i], strands[i], first));
  const Middles middles(at, locks, std::max(glm::distance(low, high) / std::sqrt(double(locks)), 1e-6));
  for (std::size_t i = locks; i < strands.size(); ++i) {
    const std::size_t middle = middles.nearest(i);
    if (middle != i) aim(strands[i], at[i], tips[i] + pull * (tips[middle] - tips[i]) - at[i].root, first);
  }
}

}  // namespace pelage::strands
