#include "harness/strands/opengl/host_strands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include "harness/strands/drawing/film_table.hpp"

namespace pelage::strands {
namespace {

// Strands that are not drawn, and with BackFacing::last those that face away. A sort key of a strand that is
// drawn is lower, because at most 255 fur layers are possible then.
constexpr std::uint32_t not_drawn = 0xffffffffu, faces_away = 0xfffffffeu;

glm::vec3 along_plane(glm::vec3 v, glm::vec3 n) {
  return glm::normalize(v - glm::dot(v, n) * n);
}

glm::vec3 rotated(glm::vec3 v, glm::vec3 axis, float degrees) {
  const float angle = glm::radians(degrees), c = std::cos(angle), s = std::sin(angle);
  return c * v + (1 - c) * glm::dot(axis, v) * axis + s * glm::cross(axis, v);
}

/// Returns v, rotated as the shortest rotation turns the unit vector `from` to the unit vector `to`.
glm::vec3 carried(glm::vec3 v, glm::vec3 from, glm::vec3 to) {
  const float c = glm::dot(from, to);
  const glm::vec3 axis = glm::cross(from, to);
  return c * v + glm::dot(axis, v) / std::max(1 + c, 1.0f / 1024) * axis + glm::cross(axis, v);
}

float times(glm::vec4 row, glm::vec3 p) {
  return row.x * p.x + row.y * p.y + row.z * p.z + row.w;
}

glm::vec3 in_view(glm::vec4 x, glm::vec4 y, glm::vec4 w, glm::vec3 p) {
  return {times(x, p), times(y, p), times(w, p)};
}

/// Returns true if all control points are beyond one side of the picture. The arguments are the control
/// points' X or Y, their W, half of the picture's size and the width of the strand times W.
bool beyond(const std::array<glm::vec3, 3>& view, int axis, float extent, float wide) {
  bool above = true, below = true;
  for (const glm::vec3& v : view) {
    above = above && v[axis] > extent * v.z + wide;
    below = below && v[axis] < -(extent * v.z + wide);
  }
  return above || below;
}

/// The first strands, as many as are drawn, with the widths of the level of detail.
std::vector<KeyedStrand> drawn_of(const std::vector<KeyedStrand>& strands, const Pruning& pruning) {
  std::vector<KeyedStrand> drawn(strands.begin(), strands.begin() + pruning.drawn);
  for (std::size_t i = 0; i < drawn.size(); ++i)
    drawn[i].width *=
        pruning.widen * std::min(float(std::size_t(pruning.drawn) - i) * pruning.per_fade, 1.0f);
  return drawn;
}

}  // namespace

/// A strand's control points, its root, and the normal there.
struct HostStrands::Curve {
  std::array<glm::vec3, 3> point;
  glm::vec3 root, normal;
};

HostStrands::HostStrands(const DrawingScene& scene, const std::vector<KeyedStrand>& strands)
    : scene_(scene),
      lights_(has_lights(scene.look)),
      map_(scene.look.shadow.reading != Shadow::none),
      fill_(irradiance_of(scene.look)),
      light_(map_ ? light_view(scene.look) : LightView{}),
      pruning_(strands.empty() ? Pruning{} : pruning_of(strands.size(), scene.look)),
      strands_(drawn_of(strands, pruning_)),
      layers_(film_table(scene.look).layers),
      keys_(strands_.size()) {
  need_looks(scene.look, strands);
  records_.strand.resize(strands_.size());
  if (lights_) records_.light.resize(strands_.size());
  if (map_) in_light_.strand.resize(strands_.size());
  if (!scene.shapes) return;
  for (std::size_t i = 0; i < strands_.size(); ++i) {
    const StrandShape& s = (*scene.shapes)[i];
    records_.shape.push_back({s.from, s.to, s.width_end, 0});
  }
  if (map_) in_light_.shape = records_.shape;
}

HostStrands::Curve HostStrands::curve_of(const std::vector<KeyStrand>& keys, std::size_t number) const {
  const KeyedStrand& s = strands_[number];
  const KeyStrand &a = keys[s.key[0]], &b = keys[s.key[1]], &c = keys[s.key[2]];
  const float wa = 1 - s.weight.x - s.weight.y, wb = s.weight.x, wc = s.weight.y;
  const auto mean = [&](glm::vec3 KeyStrand::*v) { return wa * a.*v + wb * b.*v + wc * c.*v; };
  const glm::vec3 root = mean(&KeyStrand::root), n = glm::normalize(mean(&KeyStrand::normal));
  glm::vec3 u = glm::normalize(mean(&KeyStrand::first)), w = glm::normalize(mean(&KeyStrand::second));
  if (s.response != 1) {
    const glm::vec3 rest = glm::normalize(mean(&KeyStrand::rest));
    u = glm::normalize(rest + s.response * (u - rest));
    w = glm::normalize(rest + s.response * (w - rest));
  }
  if (s.twist != 0) {
    u = rotated(u, n, s.twist);
    w = rotated(w, n, s.twist);
  }
  if (const glm::vec3 axis = glm::cross(n, u); s.curvature != 0 && glm::dot(axis, axis) > 1e-14f)
    w = rotated(w, glm::normalize(axis), s.curvature);
  if (glm::dot(n, u) < 0) u = along_plane(u, n);
  const float first = scene_.first_segment, slope = (1 - first) / first, rise = glm::dot(n, u);
  if (rise + slope * glm::dot(n, w) < 0) {
    const float sine = -rise / slope;
    w = sine * n + std::sqrt(1 - sine * sine) * along_plane(w, n);
  }
  const glm::vec3 joint = root + first * s.length * u, tip = joint + (1 - first) * s.length * w;
  if (!scene_.shapes) return {{root, joint, tip}, root, n};
  const StrandShape& shape = (*scene_.shapes)[number];
  const std::array<float, 3> place{shape.from, shape.middle(), shape.to};
  Curve curve{{}, root, n};
  for (std::size_t i = 0; i < 3; ++i) {
    const float t = place[i];
    const glm::vec3 on = (1 - t) * (1 - t) * root + 2 * t * (1 - t) * joint + t * t * tip;
    curve.point[i] =
        on + glm::mix(carried(shape.offset[i], a.rest, u), carried(shape.offset[i], a.rest, w), t);
  }
  return curve;
}

void HostStrands::set_light(const Curve& curve, const KeyedStrand& s, std::size_t at) {
  const Look& look = scene_.look;
  const LayerLook& layer = layers_[s.layer];
  const glm::vec3 n = curve.normal, eye = glm::normalize(curve.point[1] - scene_.camera.eye);
  const std::array<double, 9> basis = basis_at(glm::dvec3(n));
  glm::vec3 fill(0);
  for (std::size_t i = 0; i < basis.size(); ++i) fill += float(basis[i]) * fill_[i];
  const glm::vec3 base = glm::vec3(s.colour[0], s.colour[1], s.colour[2]) / 255.0f;
  LightRecord& r = records_.light[at];
  r.steady =
      base * (look.ambient + glm::max(fill, 0.0f)) +
      look.rim * layer.rim *
          std::pow(std::max(0.0f, 1 - std::abs(glm::dot(n, eye))), look.rim_exponent * layer.rim_exponent);
  const float scale = 1 / (look.skin_shadow_height * s.length);
  records_.strand[at].joint_height = scale * glm::dot(n, curve.point[1] - curve.root);
  r.tip_height = scale * glm::dot(n, curve.point[2] - curve.root);
  if (scene_.shapes) records_.shape[at].root_height = scale * glm::dot(n, curve.point[0] - curve.root);
}

/// The sort key of a strand: the lowest one is in front. `width_end`: its width at the end divided by that at
/// the start. `away`: the strand faces away from the camera.
std::uint32_t HostStrands::key_of(const StrandRecord& r, float width_end, int rank, bool away) const {
  const float wide = 1.5f * r.radius * std::max(1.0f, width_end);
  const Camera& c = scene_.camera;
  const std::array<glm::vec3, 3>& v = r.view;
  if (v[0].z < c.near && v[1].z < c.near && v[2].z < c.near) return not_drawn;
  const bool in_front = v[0].z >= c.near && v[1].z >= c.near && v[2].z >= c.near;
  if (in_front &&
      (beyond(v, 0, 0.5f * float(c.width) + 1, wide) || beyond(v, 1, 0.5f * float(c.height) + 1, wide)))
    return not_drawn;
  if (away && scene_.look.back_facing == BackFacing::last) return faces_away;
  const DepthRange& range = scene_.range;
  const float step = std::min(std::max((v[1].z - range.nearest) * range.per_depth, 0.0f), 16777215.0f);
  return std::uint32_t(rank) << 24 | std::uint32_t(step);
}

void HostStrands::interpolate(const std::vector<KeyStrand>& keys) {
  const auto count = std::int64_t(strands_.size());
  const Camera& c = scene_.camera;
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < count; ++i) {
    const auto at = std::size_t(i);
    const KeyedStrand& s = strands_[at];
    const LayerLook& layer = layers_[s.layer];
    const Curve curve = curve_of(keys, at);
    const std::uint32_t framed = scene_.shapes ? s.key[0] : std::uint32_t(i);
    const auto frame =
        std::uint32_t(std::uint64_t(std::uint32_t(framed * 2654435761u)) * std::uint64_t(layer.frames) >> 32);
    const std::uint32_t colour = std::uint32_t(s.colour[0]) | std::uint32_t(s.colour[1]) << 8 |
                                 std::uint32_t(s.colour[2]) << 16 |
                                 (std::uint32_t(layer.first_frame) + frame) << 24;
    const glm::vec3 to_eye = c.eye - curve.root;
    const float facing = glm::dot(curve.normal, to_eye);
    const bool away = facing < 0 && facing * facing > 0.0625f * glm::dot(to_eye, to_eye);
    const bool removed = away && scene_.look.back_facing == BackFacing::removed;
    keys_[at] = not_drawn;
    if (removed && !map_) continue;
    StrandRecord& r = records_.strand[at];
    if (!removed) {
      for (std::size_t k = 0; k < 3; ++k) r.view[k] = in_view(c.row_x, c.row_y, c.row_w, curve.point[k]);
      r.radius = 0.5f * s.width / c.pixel;
      r.colour = colour;
      keys_[at] = key_of(r, scene_.shapes ? records_.shape[at].width_end : 1, layer.rank, away);
      if (lights_ && keys_[at] != not_drawn) set_light(curve, s, at);
    }
    if (!map_) continue;
    StrandRecord& shadow = in_light_.strand[at];
    for (std::size_t k = 0; k < 3; ++k)
      shadow.view[k] = in_view(light_.row_x, light_.row_y, light_.row_z, curve.point[k]);
    shadow.radius = 0.5f * s.width / light_.texel;
    shadow.colour = colour;
  }
}

/// A radix sort with three digits of 11 bits. The list is then reversed while the records are copied.
void HostStrands::sort() {
  static constexpr std::array<int, 3> shift{0, 11, 22};
  static constexpr std::uint32_t mask = 2047;
  entries_.clear();
  std::array<std::array<std::uint32_t, 2048>, 3> next{};
  for (std::uint32_t i = 0; i < keys_.size(); ++i) {
    const std::uint32_t key = keys_[i];
    if (key == not_drawn) continue;
    entries_.push_back({key, i});
    for (std::size_t k = 0; k < 3; ++k) ++next[k][key >> shift[k] & mask];
  }
  for (auto& digits : next) {
    std::uint32_t sum = 0;
    for (std::uint32_t& digit : digits) {
      const std::uint32_t here = digit;
      digit = sum;
      sum += here;
    }
  }
  other_.resize(entries_.size());
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Item& e : entries_) other_[next[k][e.key >> shift[k] & mask]++] = e;
    entries_.swap(other_);
  }
  if (scene_.look.back_facing == BackFacing::last)
    while (!entries_.empty() && entries_.back().key == faces_away) entries_.pop_back();
}

const Records& HostStrands::back_to_front() {
  sort();
  const auto count = std::int64_t(entries_.size());
  sorted_.strand.resize(entries_.size());
  if (lights_) sorted_.light.resize(entries_.size());
  if (scene_.shapes) sorted_.shape.resize(entries_.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < count; ++i) {
    const std::uint32_t strand = entries_[std::size_t(count - 1 - i)].strand;
    sorted_.strand[std::size_t(i)] = records_.strand[strand];
    if (lights_) sorted_.light[std::size_t(i)] = records_.light[strand];
    if (scene_.shapes) sorted_.shape[std::size_t(i)] = records_.shape[strand];
  }
  return sorted_;
}

}  // namespace pelage::strands
