#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/strands/reference/drawing.hpp"

namespace pelage::strands::reference {
namespace {

// A segment is not drawn if it is shorter, in pixels.
constexpr double shortest_segment = 1.0 / 1024;

/// Returns the direction across the line that separates two segments with the unit vectors `before` and
/// `behind`; one of them may be zero. If the segments lie on each other, the line is along the segments, so
/// that each of them has one half of the strip.
glm::dvec2 mitre(glm::dvec2 before, glm::dvec2 behind) {
  const glm::dvec2 sum = before + behind;
  return glm::length(sum) < 1.0 / 1024 ? glm::dvec2(-before.y, before.x) : sum;
}

/// Visits the fragments of the segment from `a` to `b`. `e` is its direction. The lines through a and b that
/// are orthogonal to `mitre_a` and `mitre_b` separate it from its neighbours.
void segment(const Vertex& a, const Vertex& b, glm::dvec2 e, double length, glm::dvec2 mitre_a,
             glm::dvec2 mitre_b, int width, int height, const Visit& visit) {
  const double reach = std::max(a.half, b.half) + 0.5;  // a mitre extends no further beyond the end
  const glm::dvec2 low = glm::min(a.place, b.place) - 2 * reach,
                   high = glm::max(a.place, b.place) + 2 * reach;
  const auto clamped = [](double value, int limit) { return int(std::clamp(value, 0.0, double(limit))); };
  for (int y = clamped(std::floor(low.y), height); y < clamped(std::ceil(high.y), height); ++y) {
    for (int x = clamped(std::floor(low.x), width); x < clamped(std::ceil(high.x), width); ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5), from = p - a.place;
      if (glm::dot(from, mitre_a) < 0 || glm::dot(p - b.place, mitre_b) >= 0) continue;
      const double along = glm::dot(from, e), across = from.x * e.y - from.y * e.x;
      if (along < -reach || along > length + reach) continue;
      const double s = std::clamp(along / length, 0.0, 1.0);
      const double half = a.half + s * (b.half - a.half);
      const double coverage = std::min(across + half, 0.5) - std::max(across - half, -0.5);
      if (coverage <= 0) continue;
      visit(x, y,
            {coverage * (a.alpha + s * (b.alpha - a.alpha)), a.colour + s * (b.colour - a.colour),
             a.depth + s * (b.depth - a.depth)});
    }
  }
}

}  // namespace

void each_fragment(const std::vector<Vertex>& vertices, int width, int height, const Visit& visit) {
  std::vector<glm::dvec2> direction;  // of each segment; 0 for a segment that is not drawn
  std::vector<double> length;
  for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
    const glm::dvec2 step = vertices[k + 1].place - vertices[k].place;
    length.push_back(glm::length(step));
    direction.push_back(length.back() < shortest_segment ? glm::dvec2(0) : step / length.back());
  }
  for (std::size_t k = 0; k < direction.size(); ++k) {
    if (direction[k] == glm::dvec2(0)) continue;
    const glm::dvec2 before = k > 0 ? direction[k - 1] : glm::dvec2(0);
    const glm::dvec2 behind = k + 1 < direction.size() ? direction[k + 1] : glm::dvec2(0);
    segment(vertices[k], vertices[k + 1], direction[k], length[k], mitre(before, direction[k]),
            mitre(direction[k], behind), width, height, visit);
  }
}

namespace {

using Vec = glm::dvec3;

/// The part of v that is parallel to the plane with the normal n, normalized.
Vec along_plane(Vec v, Vec n) {
  return glm::normalize(v - glm::dot(v, n) * n);
}

/// Returns v, rotated about a unit vector by an angle in degrees.
Vec rotated(Vec v, Vec axis, float degrees) {
  const double angle = double(degrees) * std::numbers::pi / 180;
  const Vec along = glm::dot(axis, v) * axis;
  return along + std::cos(angle) * (v - along) + std::sin(angle) * glm::cross(axis, v);
}

/// A strand without its control points: root, normal of the skin, and directions of the two segments.
struct Bent {
  Vec root, n, u, w;
  double magnified;  ///< see between()
};

Bent bent(const std::vector<KeyStrand>& keys, const KeyedStrand& strand, float first_segment) {
  const double s = strand.weight.x, t = strand.weight.y;
  const auto mean = [&](glm::vec3 KeyStrand::*vector) {
    return (1 - s - t) * Vec(keys[strand.key[0]].*vector) + s * Vec(keys[strand.key[1]].*vector) +
           t * Vec(keys[strand.key[2]].*vector);
  };
  const Vec root = mean(&KeyStrand::root), n = glm::normalize(mean(&KeyStrand::normal));
  const Vec rest = glm::normalize(mean(&KeyStrand::rest));
  const auto moved = [&](Vec v) { return glm::normalize(rest + double(strand.response) * (v - rest)); };
  Vec u = moved(glm::normalize(mean(&KeyStrand::first))), w = moved(glm::normalize(mean(&KeyStrand::second)));
  u = rotated(u, n, strand.twist);
  w = rotated(w, n, strand.twist);
  double factor = 1;
  if (const Vec axis = glm::cross(n, u); glm::length(axis) > 1e-9) {
    w = rotated(w, glm::normalize(axis), strand.curvature);
    factor += std::abs(std::sin(double(strand.curvature) * std::numbers::pi / 180)) / glm::length(axis);
  }
  const double l1 = first_segment, l2 = 1 - l1;
  if (glm::dot(n, u) < 0) u = along_plane(u, n);
  if (l1 * glm::dot(n, u) + l2 * glm::dot(n, w) < 0) {
    const double sine = -l1 / l2 * glm::dot(n, u);
    factor /= glm::length(w - glm::dot(w, n) * n);
    w = sine * n + std::cos(std::asin(sine)) * along_plane(w, n);
  }
  return {root, n, u, w, factor};
}

/// Returns v, rotated by the rotation with the smallest angle from the unit vector `from` to the unit vector
/// `to`. Near 180 degrees, where it is not defined, the result is shorter (docs/grooms.md).
Vec carried(Vec v, Vec from, Vec to) {
  const double cosine = glm::dot(from, to);
  const Vec axis = glm::cross(from, to);
  return cosine * v + glm::dot(axis, v) / std::max(1 + cosine, 1.0 / 1024) * axis + glm::cross(axis, v);
}

/// The attributes of a strand without its control points.
DrawnStrand attributes_of(const KeyedStrand& strand, Vec normal) {
  DrawnStrand drawn;
  drawn.normal = glm::vec3(normal);
  drawn.colour = glm::vec3(strand.colour[0], strand.colour[1], strand.colour[2]) / 255.0f;
  drawn.width = strand.width;
  drawn.layer = drawn.rank = strand.layer;
  return drawn;
}

}  // namespace

DrawnStrand between(const std::vector<KeyStrand>& keys, const KeyedStrand& strand, float first_segment,
                    double* magnified) {
  const Bent b = bent(keys, strand, first_segment);
  if (magnified) *magnified = b.magnified;
  DrawnStrand drawn = attributes_of(strand, b.n);
  const double l1 = first_segment, length = strand.length;
  const Vec joint = b.root + l1 * length * b.u;
  drawn.point = {glm::vec3(b.root), glm::vec3(joint), glm::vec3(joint + (1 - l1) * length * b.w)};
  return drawn;
}

DrawnStrand shaped(const std::vector<KeyStrand>& keys, const KeyedStrand& strand, const StrandShape& shape,
                   float first_segment, double* magnified) {
  const Bent b = bent(keys, strand, first_segment);
  const Vec rest = glm::normalize(Vec(keys[strand.key[0]].rest));
  const double l1 = first_segment, length = strand.length;
  const Vec joint = b.root + l1 * length * b.u, tip = joint + (1 - l1) * length * b.w;
  const std::array<double, 3> place{double(shape.from), double(shape.middle()), double(shape.to)};
  DrawnStrand curve = attributes_of(strand, b.n);
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double s = place[i];
    const Vec on = (1 - s) * (1 - s) * b.root + 2 * s * (1 - s) * joint + s * s * tip,
              offset(shape.offset[i]);
    curve.point[i] = glm::vec3(on + (1 - s) * carried(offset, rest, b.u) + s * carried(offset, rest, b.w));
    largest = std::max(largest, glm::length(offset));
  }
  curve.part =
      StrandPart{shape.from, shape.to, shape.width_end, glm::vec3(b.root), strand.length, strand.key[0]};
  if (magnified) {
    const double least = 1 + std::min(glm::dot(rest, b.u), glm::dot(rest, b.w));
    *magnified = b.magnified * std::max(1.0, length) + 16 * largest / std::max(least, 1.0 / 1024);
  }
  return curve;
}

}  // namespace pelage::strands::reference
