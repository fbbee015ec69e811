#include "harness/strands/reference/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <optional>

namespace pelage::strands::reference {
namespace {

using Vec = glm::dvec3;

// A segment is not drawn if it is shorter, in pixels.
constexpr double shortest_segment = 1.0 / 1024;

/// A point in view coordinates: x and y are pixels from the image centre times the view depth, z is the view
/// depth in R.
Vec in_view(const Camera& camera, glm::vec3 p) {
  const glm::dvec4 q(Vec(p), 1.0);
  return {glm::dot(glm::dvec4(camera.row_x), q), glm::dot(glm::dvec4(camera.row_y), q),
          glm::dot(glm::dvec4(camera.row_w), q)};
}

/// The curve of one strand.
struct Curve {
  std::array<Vec, 3> p;  ///< control points
  Vec at(double t) const { return (1 - t) * (1 - t) * p[0] + 2 * t * (1 - t) * p[1] + t * t * p[2]; }
  Vec tangent(double t) const { return (1 - t) * (p[1] - p[0]) + t * (p[2] - p[1]); }
};

/// The part of a curve's parameter in which the curve is drawn.
struct Part {
  double from = 0, to = 1;
};

/// Returns the parameter between `front` and `behind` at which the curve crosses the near plane. The curve is
/// in front of the plane at `front` and not at `behind`.
double crossing(const Curve& view, double near, double front, double behind) {
  for (int i = 0; i < 60; ++i) {
    const double middle = (front + behind) / 2;
    (view.at(middle).z >= near ? front : behind) = middle;
  }
  return front;
}

/// Cuts the curve at the near plane. Of the vertices k / segments, the part contains those from the root to
/// the first one behind the plane; if the root is behind it, those from the last one behind the plane to the
/// tip.
std::optional<Part> visible_part(const Curve& view, double near, int segments) {
  std::vector<bool> front;
  for (int k = 0; k <= segments; ++k) front.push_back(view.at(double(k) / segments).z >= near);
  const auto first_behind = std::find(front.begin(), front.end(), false);
  if (first_behind == front.end()) return Part{};
  if (front.front()) {
    const double k = double(first_behind - front.begin());
    return Part{0, crossing(view, near, (k - 1) / segments, k / segments)};
  }
  if (!front.back()) return {};
  const auto last_behind = std::find(front.rbegin(), front.rend(), false);
  const double k = double(segments) - double(last_behind - front.rbegin());
  return Part{crossing(view, near, (k + 1) / segments, k / segments), 1};
}

struct Vertex {
  glm::dvec2 place;  ///< pixels from the top left corner of the picture
  double half = 0;   ///< half of the strand's width, pixels
  double alpha = 0;
  Vec colour;
};

/// Light of Kajiya and Kay on a hair with the tangent T, without the highlight's factor: x is |T x L|, and y
/// the power of (T.L)(T.E) + |T x L||T x E|. E points from the eye to the joint.
glm::dvec2 hair_light(const Look& look, Vec tangent, Vec from_eye) {
  const Vec light = glm::normalize(Vec(look.light));
  const double along_light = glm::dot(tangent, light), along_eye = glm::dot(tangent, from_eye);
  const double across_light = glm::length(glm::cross(tangent, light));
  const double across_eye = glm::length(glm::cross(tangent, from_eye));
  const double mirror = std::max(0.0, along_light * along_eye + across_light * across_eye);
  return {across_light, std::pow(mirror, double(look.exponent))};
}

/// The real spherical harmonics of degree l = 0, 1, 2 at a unit vector.
std::array<double, 9> harmonics(Vec n) {
  const double pi = std::numbers::pi, first = std::sqrt(3 / (4 * pi)), second = std::sqrt(15 / pi) / 2;
  return {std::sqrt(1 / (4 * pi)),
          first * n.y,
          first * n.z,
          first * n.x,
          second * n.x * n.y,
          second * n.y * n.z,
          std::sqrt(5 / pi) / 4 * (3 * n.z * n.z - 1),
          second * n.x * n.z,
          second / 2 * (n.x * n.x - n.y * n.y)};
}

/// F: the light of all fill lights on a surface with the normal n.
Vec fill_light(const Look& look, Vec n) {
  const double pi = std::numbers::pi;
  const std::array<double, 9> here = harmonics(n);
  Vec sum(0);
  for (const FillLight& fill : look.fills) {
    const std::array<double, 9> there = harmonics(glm::normalize(Vec(fill.direction)));
    for (std::size_t i = 0; i < (look.bands == 2 ? 9u : 4u); ++i)
      sum += (i == 0 ? pi : i < 4 ? 2 * pi / 3 : pi / 4) * here[i] * there[i] * Vec(fill.colour);
  }
  return glm::max(sum, Vec(0));
}

/// The factors of the film strip at one place of a strand.
struct Film {
  double luminance = 1, gloss = 1, opacity = 1;
};

Film film_at(const Look& look, std::uint32_t strand, double t) {
  if (look.film.empty()) return {};
  const std::uint64_t hash = std::uint32_t(strand * 2654435761u);
  const FilmFrame& frame = look.film[std::size_t(hash * look.film.size() >> 32)];
  const double place = 7 * t;
  const auto first = std::min(std::size_t(place), std::size_t(6));
  const auto between = [&](std::uint8_t FilmSample::*value) {
    return double(frame[first].*value) +
           (place - double(first)) * (double(frame[first + 1].*value) - double(frame[first].*value));
  };
  return {between(&FilmSample::luminance) / 128, between(&FilmSample::gloss) / 128,
          between(&FilmSample::opacity) / 255};
}

std::vector<Vertex> vertices_of(const Camera& camera, const Look& look, const DrawnStrand& strand,
                                std::uint32_t number) {
  Curve object, view;
  for (std::size_t i = 0; i < 3; ++i) {
    object.p[i] = Vec(strand.point[i]);
    view.p[i] = in_view(camera, strand.point[i]);
  }
  const std::optional<Part> part = visible_part(view, camera.near, look.segments);
  if (!part) return {};
  const Vec from_eye = glm::normalize(object.p[1] - Vec(camera.eye)), normal(strand.normal);
  const Vec base(strand.colour);
  const Vec steady = base * (double(look.ambient) + fill_light(look, normal)) +
                     Vec(look.rim) * std::pow(1 - std::min(1.0, std::abs(glm::dot(normal, from_eye))),
                                              double(look.rim_exponent));
  const double strand_length =
      glm::distance(object.p[0], object.p[1]) + glm::distance(object.p[1], object.p[2]);
  std::vector<Vertex> vertices;
  for (int k = 0; k <= look.segments; ++k) {
    const double t = part->from + (part->to - part->from) * k / look.segments;
    const Vec v = view.at(t), tangent = object.tangent(t);
    const double length = glm::length(tangent);
    Vertex vertex;
    vertex.place = glm::dvec2(v) / v.z + 0.5 * glm::dvec2(camera.width, camera.height);
    vertex.half = 0.5 * double(strand.width) * (1 - double(look.taper) * t) / (double(camera.pixel) * v.z);
    const Film film = film_at(look, number, t);
    vertex.alpha = double(look.opacity) * film.opacity * (1 - t * t * t);
    const glm::dvec2 light = hair_light(look, length > 0 ? tangent / length : Vec(0), from_eye);
    const double height = std::max(0.0, glm::dot(normal, object.at(t) - object.p[0]));
    const double shadow =
        1 - double(look.skin_shadow) *
                (1 - std::min(1.0, height / (double(look.skin_shadow_height) * strand_length)));
    vertex.colour =
        shadow * film.luminance *
        (steady + double(look.intensity) * (base * light.x + film.gloss * Vec(look.specular) * light.y));
    vertices.push_back(vertex);
  }
  return vertices;
}

/// One fragment of a strand.
struct Fragment {
  double alpha;
  Vec colour;
};

class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width), height_(height), fragments_(std::size_t(width) * std::size_t(height)) {}

  void draw(const std::vector<Vertex>& vertices) {
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
      segment(vertices[k], vertices[k + 1], direction[k], length[k], direction[k] + before,
              direction[k] + behind);
    }
  }

  Picture composed(Vec background) const {
    Picture picture{width_, height_, {}};
    for (const std::vector<Fragment>& pixel : fragments_) {
      Vec colour(0);
      double through = 1;
      for (const Fragment& f : pixel) {
        colour += through * f.alpha * f.colour;
        through *= 1 - f.alpha;
      }
      picture.pixel.emplace_back(glm::vec3(colour + through * background), float(1 - through));
    }
    return picture;
  }

 private:
  /// Adds the fragments of the segment from `a` to `b`. `e` is its direction. The lines through a and b that
  /// are orthogonal to `mitre_a` and `mitre_b` separate it from its neighbours.
  void segment(const Vertex& a, const Vertex& b, glm::dvec2 e, double length, glm::dvec2 mitre_a,
               glm::dvec2 mitre_b) {
    const double reach =
        std::max(a.half, b.half) + 0.5;  // a mitre extends no further beyond the end of the segment
    const glm::dvec2 low = glm::min(a.place, b.place) - 2 * reach,
                     high = glm::max(a.place, b.place) + 2 * reach;
    const auto clamped = [](double value, int limit) { return int(std::clamp(value, 0.0, double(limit))); };
    for (int y = clamped(std::floor(low.y), height_); y < clamped(std::ceil(high.y), height_); ++y) {
      for (int x = clamped(std::floor(low.x), width_); x < clamped(std::ceil(high.x), width_); ++x) {
        const glm::dvec2 p(x + 0.5, y + 0.5), from = p - a.place;
        if (glm::dot(from, mitre_a) < 0 || glm::dot(p - b.place, mitre_b) >= 0) continue;
        const double along = glm::dot(from, e), across = from.x * e.y - from.y * e.x;
        if (along < -reach || along > length + reach) continue;
        const double s = std::clamp(along / length, 0.0, 1.0);
        const double half = a.half + s * (b.half - a.half);
        const double coverage = std::min(across + half, 0.5) - std::max(across - half, -0.5);
        if (coverage <= 0) continue;
        fragments_[std::size_t(y) * std::size_t(width_) + std::size_t(x)].push_back(
            {coverage * (a.alpha + s * (b.alpha - a.alpha)), a.colour + s * (b.colour - a.colour)});
      }
    }
  }

  int width_, height_;
  std::vector<std::vector<Fragment>> fragments_;  ///< fragments of each pixel, from front to back
};

float dot_f(glm::vec3 a, glm::vec3 b) {
  return std::fma(a.z, b.z, std::fma(a.y, b.y, a.x * b.x));
}

float times(glm::vec4 row, glm::vec3 p) {
  return std::fma(p.x, row.x, std::fma(p.y, row.y, std::fma(p.z, row.z, row.w)));
}

/// Returns true if the strand is entirely in front of the near plane, and all its control points are beyond
/// one side of the picture. `row` is the row of the projection of one axis, and `size` the picture's size
/// along this axis.
bool beyond_side(const Camera& camera, const DrawnStrand& strand, glm::vec4 row, int size) {
  const float wide = 1.5f * (strand.width * (0.5f / camera.pixel)), extent = 0.5f * float(size) + 1.0f;
  bool above = true, below = true;
  for (const glm::vec3& point : strand.point) {
    const float depth = times(camera.row_w, point), place = times(row, point);
    const float side = std::fma(extent, depth, wide);
    if (depth < camera.near) return false;
    above = above && place > side;
    below = below && place < -side;
  }
  return above || below;
}

}  // namespace

std::vector<Entry> drawing_order(const Camera& camera, const DepthRange& range,
                                 const std::vector<DrawnStrand>& strands) {
  const auto depth = [&](glm::vec3 p) { return times(camera.row_w, p); };
  std::vector<Entry> order;
  for (std::uint32_t i = 0; i < strands.size(); ++i) {
    const DrawnStrand& strand = strands[i];
    const glm::vec3 to_eye = camera.eye - strand.point[0];
    const float facing = dot_f(strand.normal, to_eye);
    if (facing < 0 && facing * facing > 0.0625f * dot_f(to_eye, to_eye)) continue;
    const float joint = depth(strand.point[1]);
    if (std::max({depth(strand.point[0]), joint, depth(strand.point[2])}) < camera.near) continue;
    if (beyond_side(camera, strand, camera.row_x, camera.width)) continue;
    if (beyond_side(camera, strand, camera.row_y, camera.height)) continue;
    const float step = std::clamp((joint - range.nearest) * range.per_depth, 0.0f, 16777215.0f);
    order.push_back({std::uint32_t(strand.rank) << 24 | std::uint32_t(step), i});
  }
  std::stable_sort(order.begin(), order.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  return order;
}

Picture draw(const Camera& camera, const Look& look, const std::vector<DrawnStrand>& strands,
             const std::vector<Entry>& order) {
  Canvas canvas(camera.width, camera.height);
  for (const Entry& entry : order) {
    const std::vector<Vertex> vertices = vertices_of(camera, look, strands[entry.strand], entry.strand);
    if (!vertices.empty()) canvas.draw(vertices);
  }
  return canvas.composed(Vec(look.background));
}

}  // namespace pelage::strands::reference
