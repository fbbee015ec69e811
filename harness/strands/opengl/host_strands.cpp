#include "harness/strands/opengl/host_strands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace pelage::strands {
namespace {

constexpr std::uint32_t not_drawn = 0xffffffffu;

glm::vec3 along_plane(glm::vec3 v, glm::vec3 n) {
  return glm::normalize(v - glm::dot(v, n) * n);
}

/// A strand's control points, and the normal at its root.
struct Curve {
  std::array<glm::vec3, 3> point;
  glm::vec3 normal;
};

Curve curve_of(const std::vector<KeyStrand>& keys, const KeyedStrand& s, float first) {
  const KeyStrand &a = keys[s.key[0]], &b = keys[s.key[1]], &c = keys[s.key[2]];
  const float wa = 1 - s.weight.x - s.weight.y, wb = s.weight.x, wc = s.weight.y;
  const glm::vec3 root = wa * a.root + wb * b.root + wc * c.root;
  const glm::vec3 n = glm::normalize(wa * a.normal + wb * b.normal + wc * c.normal);
  glm::vec3 u = glm::normalize(wa * a.first + wb * b.first + wc * c.first);
  glm::vec3 w = glm::normalize(wa * a.second + wb * b.second + wc * c.second);
  if (glm::dot(n, u) < 0) u = along_plane(u, n);
  const float slope = (1 - first) / first, rise = glm::dot(n, u);
  if (rise + slope * glm::dot(n, w) < 0) {
    const float sine = -rise / slope;
    w = sine * n + std::sqrt(1 - sine * sine) * along_plane(w, n);
  }
  const glm::vec3 joint = root + first * s.length * u;
  return {{root, joint, joint + (1 - first) * s.length * w}, n};
}

float times(glm::vec4 row, glm::vec3 p) {
  return row.x * p.x + row.y * p.y + row.z * p.z + row.w;
}

/// Returns true if all control points are beyond one side of the picture. The arguments are the control
/// points' X or Y, their W, half of the picture's size and the width of the strand times W.
bool beyond(const std::array<float, 3>& place, const std::array<float, 3>& depth, float extent, float wide) {
  bool above = true, below = true;
  for (std::size_t i = 0; i < 3; ++i) {
    above = above && place[i] > extent * depth[i] + wide;
    below = below && place[i] < -(extent * depth[i] + wide);
  }
  return above || below;
}

}  // namespace

HostStrands::HostStrands(const DrawingScene& scene, const std::vector<KeyedStrand>& strands)
    : camera_(scene.camera),
      range_(scene.range),
      first_segment_(scene.first_segment),
      strands_(strands),
      records_(strands.size()),
      keys_(strands.size()) {
  for (const KeyedStrand& s : strands) ranks_.push_back(std::uint32_t(layer_look(scene.look, s.layer).rank));
}

void HostStrands::interpolate(const std::vector<KeyStrand>& keys) {
  const auto count = std::int64_t(strands_.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < count; ++i) {
    const auto at = std::size_t(i);
    const KeyedStrand& s = strands_[at];
    const Curve curve = curve_of(keys, s, first_segment_);
    keys_[at] = not_drawn;
    const glm::vec3 to_eye = camera_.eye - curve.point[0];
    const float facing = glm::dot(curve.normal, to_eye);
    if (facing < 0 && facing * facing > 0.0625f * glm::dot(to_eye, to_eye)) continue;
    StrandRecord& r = records_[at];
    std::array<float, 3> x{}, y{}, w{};
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = times(camera_.row_x, curve.point[k]);
      y[k] = times(camera_.row_y, curve.point[k]);
      w[k] = times(camera_.row_w, curve.point[k]);
      r.view[k] = {x[k], y[k], w[k]};
    }
    const float near = camera_.near;
    if (w[0] < near && w[1] < near && w[2] < near) continue;
    r.radius = 0.5f * s.width / camera_.pixel;
    const bool in_front = w[0] >= near && w[1] >= near && w[2] >= near;
    if (in_front && (beyond(x, w, 0.5f * float(camera_.width) + 1, 1.5f * r.radius) ||
                     beyond(y, w, 0.5f * float(camera_.height) + 1, 1.5f * r.radius)))
      continue;
    r.colour =
        std::uint32_t(s.colour[0]) | std::uint32_t(s.colour[1]) << 8 | std::uint32_t(s.colour[2]) << 16;
    const float step = std::min(std::max((w[1] - range_.nearest) * range_.per_depth, 0.0f), 16777215.0f);
    keys_[at] = ranks_[at] << 24 | std::uint32_t(step);
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
}

const std::vector<StrandRecord>& HostStrands::back_to_front(const std::vector<KeyStrand>& keys) {
  interpolate(keys);
  sort();
  const auto count = std::int64_t(entries_.size());
  sorted_.resize(entries_.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < count; ++i)
    sorted_[std::size_t(i)] = records_[entries_[std::size_t(count - 1 - i)].strand];
  return sorted_;
}

}  // namespace pelage::strands
