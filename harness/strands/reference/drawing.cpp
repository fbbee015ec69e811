#include "harness/strands/reference/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <optional>

namespace pelage::strands::reference {
namespace {

using Vec = glm::dvec3;

/// A point in view coordinates: x and y are pixels from the image centre times the view depth, z is the view
/// depth in R.
Vec in_view(const Camera& camera, glm::vec3 p) {
  const glm::dvec4 q(Vec(p), 1.0);
  return {glm::dot(glm::dvec4(camera.row_x), q), glm::dot(glm::dvec4(camera.row_y), q),
          glm::dot(glm::dvec4(camera.row_w), q)};
}

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

/// The number of segments of a strand with look.own_segments: the least n from 3 for which |P0 - 2 P1 + P2| /
/// (4 n^2), at the nearest control point, is at most 1/4 pixel; look.segments at most.
int segments_of(const Camera& camera, const Look& look, const DrawnStrand& strand, const Curve& view) {
  const double nearest = std::min({view.p[0].z, view.p[1].z, view.p[2].z});
  if (!look.own_segments) return least_segments(look, strand);
  if (nearest < double(camera.near)) return look.segments;
  Vec bend = view.p[0] - 2.0 * view.p[1] + view.p[2];
  bend.x *= double(camera.pixel);
  bend.y *= double(camera.pixel);
  const double pixels = glm::length(bend) / (nearest * double(camera.pixel));
  int n = strand.part ? least_segments(look, strand) : 3;
  while (n < look.segments && pixels / (4 * n * n) > 0.25) ++n;
  return std::min(n, look.segments);
}

/// Light of Kajiya and Kay on a hair with the tangent T, without the highlight's factor: x is |T x L|, and y
/// the power of (T.L)(T.E) + |T x L||T x E|. E points from the eye to the joint.
glm::dvec2 hair_light(const Look& look, double exponent, Vec tangent, Vec from_eye) {
  const Vec light = glm::normalize(Vec(look.light));
  const double along_light = glm::dot(tangent, light), along_eye = glm::dot(tangent, from_eye);
  const double across_light = glm::length(glm::cross(tangent, light));
  const double across_eye = glm::length(glm::cross(tangent, from_eye));
  const double mirror = std::max(0.0, along_light * along_eye + across_light * across_eye);
  return {across_light, std::pow(mirror, exponent)};
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

/// The factors of the strand's fur layer.
LayerLook own_look(const Look& look, const DrawnStrand& strand) {
  const auto layer = std::size_t(strand.layer);
  return layer < look.layers.size() ? look.layers[layer] : LayerLook{};
}

/// The factors of the film strip and of the fur layer at one place of a strand.
struct Film {
  double luminance = 1, gloss = 1, opacity = 1;
};

Film film_at(const Look& look, const DrawnStrand& drawn, std::uint32_t strand, double t) {
  const LayerLook own = own_look(look, drawn);
  if (look.film.empty()) return {1, double(own.gloss), double(own.opacity)};
  const std::uint64_t hash = std::uint32_t(strand * 2654435761u);
  const auto layer = std::size_t(drawn.layer);
  std::size_t begin = 0, count = look.film.size();
  if (layer < look.layers.size()) {
    begin = std::size_t(look.layers[layer].first_frame);
    count = std::size_t(look.layers[layer].frames);
  }
  const FilmFrame& frame = look.film[begin + std::size_t(hash * count >> 32)];
  const double place = 7 * t;
  const auto first = std::min(std::size_t(place), std::size_t(6));
  const auto between = [&](std::uint8_t FilmSample::*value) {
    return double(frame[first].*value) +
           (place - double(first)) * (double(frame[first + 1].*value) - double(frame[first].*value));
  };
  return {between(&FilmSample::luminance) / 128, double(own.gloss) * between(&FilmSample::gloss) / 128,
          double(own.opacity) * between(&FilmSample::opacity) / 255};
}

/// The parameter of the strand, from 0 (root) to 1 (tip), at the parameter t of its curve.
double on_strand(const DrawnStrand& strand, double t) {
  if (!strand.part) return t;
  return double(strand.part->from) + t * (double(strand.part->to) - double(strand.part->from));
}

Curve curve_of(const DrawnStrand& strand) {
  Curve curve;
  for (std::size_t i = 0; i < 3; ++i) curve.p[i] = Vec(strand.point[i]);
  return curve;
}

/// The light at all places of one strand.
class StrandLight {
 public:
  StrandLight(const Camera& camera, const Look& look, const DrawnStrand& strand, std::uint32_t number)
      : look_(look), strand_(strand), number_(number), curve_(curve_of(strand)) {
    const Vec normal(strand.normal);
    const LayerLook own = own_look(look, strand);
    exponent_ = double(look.exponent) * double(own.exponent);
    skin_shadow_ = double(look.skin_shadow) * double(own.skin_shadow);
    from_eye_ = glm::normalize(curve_.p[1] - Vec(camera.eye));
    steady_ = Vec(strand.colour) * (double(look.ambient) + fill_light(look, normal)) +
              Vec(look.rim) * Vec(own.rim) *
                  std::pow(1 - std::min(1.0, std::abs(glm::dot(normal, from_eye_))),
                           double(look.rim_exponent) * double(own.rim_exponent));
    root_ = strand.part ? Vec(strand.part->root) : curve_.p[0];
    length_ = strand.part ? double(strand.part->length)
                          : glm::distance(curve_.p[0], curve_.p[1]) + glm::distance(curve_.p[1], curve_.p[2]);
    if (strand.part) number_ = strand.part->strand;
  }

  /// Returns the colour at the parameter t. `lit` is the part of the key light that reaches this place.
  Vec colour(double t, double lit) const {
    const Vec start = curve_.tangent(0), slope = curve_.tangent(t), base(strand_.colour);
    // Where the curve turns back on itself, its derivative is zero. The tangent is then that of the root.
    const Vec tangent = glm::length(slope) < glm::length(start) / 1024 ? start : slope;
    const double length = glm::length(tangent), key = double(look_.intensity) * lit;
    const Film film = film_at(look_, strand_, number_, on_strand(strand_, t));
    const glm::dvec2 light = hair_light(look_, exponent_, length > 0 ? tangent / length : Vec(0), from_eye_);
    const double height = std::max(0.0, glm::dot(Vec(strand_.normal), curve_.at(t) - root_));
    const double shadow =
        1 - skin_shadow_ * (1 - std::min(1.0, height / (double(look_.skin_shadow_height) * length_)));
    return shadow * film.luminance *
           (steady_ + key * (base * light.x + film.gloss * Vec(look_.specular) * light.y));
  }

 private:
  const Look& look_;
  const DrawnStrand& strand_;
  std::uint32_t number_;
  Curve curve_;
  Vec from_eye_{0}, steady_{0}, root_{0};
  double length_ = 0, exponent_ = 1, skin_shadow_ = 0;
};

/// Returns the part of the key light that reaches a point, 1 without a map.
double part_of_key(const Look& look, const std::optional<ShadowMap>& shadow, Vec point) {
  return shadow ? key_light(look, shadow->view, shadow->map, point) : 1;
}

std::vector<Vertex> vertices_of(const Camera& camera, const Look& look,
                                const std::optional<ShadowMap>& shadow_map, const DrawnStrand& strand,
                                std::uint32_t number) {
  const Curve object = curve_of(strand);
  Curve view;
  for (std::size_t i = 0; i < 3; ++i) view.p[i] = in_view(camera, strand.point[i]);
  const int segments = segments_of(camera, look, strand, view);
  const std::optional<Part> part = visible_part(view, camera.near, segments);
  if (!part) return {};
  const StrandLight light(camera, look, strand, number);
  std::vector<Vertex> vertices;
  for (int k = 0; k <= segments; ++k) {
    const double t = part->from + (part->to - part->from) * k / segments;
    const Vec v = view.at(t);
    Vertex vertex;
    vertex.place = glm::dvec2(v) / v.z + 0.5 * glm::dvec2(camera.width, camera.height);
    vertex.half = half_width(look, strand, t) / (double(camera.pixel) * v.z);
    vertex.depth = v.z;
    vertex.alpha = alpha_of(look, strand, number, t);
    vertex.colour = light.colour(t, part_of_key(look, shadow_map, object.at(t)));
    vertices.push_back(vertex);
  }
  return vertices;
}

/// The pixels of a picture while strands are blended from front to back.
class Canvas {
 public:
  /// `skin` has the pixels of the skin, or is empty.
  Canvas(int width, int height, std::vector<SkinPixel> skin)
      : width_(width),
        height_(height),
        pixels_(std::size_t(width) * std::size_t(height)),
        skin_(std::move(skin)) {}

  void draw(const std::vector<Vertex>& vertices) {
    each_fragment(vertices, width_, height_, [&](int x, int y, const Fragment& fragment) {
      const std::size_t at = std::size_t(y) * std::size_t(width_) + std::size_t(x);
      const double alpha = fragment.alpha * (skin_.empty() ? 1 : before_skin(skin_[at], fragment.depth));
      Pixel& pixel = pixels_[at];
      pixel.colour += pixel.through * alpha * fragment.colour;
      pixel.through *= 1 - alpha;
      fragments_ += alpha > 0;
    });
  }

  std::uint64_t fragments() const { return fragments_; }

  Picture composed(Vec background) const {
    Picture picture{width_, height_, {}};
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const Pixel& pixel = pixels_[i];
      const bool has_skin = !skin_.empty() && skin_[i].depth < INFINITY;
      const Vec behind = has_skin ? skin_[i].colour : background;
      picture.pixel.emplace_back(glm::vec3(pixel.colour + pixel.through * behind),
                                 has_skin ? 1.0f : float(1 - pixel.through));
    }
    return picture;
  }

 private:
  struct Pixel {
    Vec colour{0};
    double through = 1;  ///< transmittance of the fragments
  };

  int width_, height_;
  std::vector<Pixel> pixels_;
  std::vector<SkinPixel> skin_;
  std::uint64_t fragments_ = 0;
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
  const float grown = strand.part ? std::max(strand.part->width_end, 1.0f) : 1.0f;
  const float wide = 1.5f * (strand.width * (0.5f / camera.pixel) * grown),
              extent = 0.5f * float(size) + 1.0f;
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

int least_segments(const Look& look, const DrawnStrand& strand) {
  return strand.part ? segments_of_part(look, strand.part->from, strand.part->to) : look.segments;
}

double half_width(const Look& look, const DrawnStrand& strand, double t) {
  const double of_part = strand.part ? 1 + t * (double(strand.part->width_end) - 1) : 1;
  return 0.5 * double(strand.width) * of_part *
         (1 - double(look.taper) * double(own_look(look, strand).taper) * on_strand(strand, t));
}

double alpha_of(const Look& look, const DrawnStrand& strand, std::uint32_t number, double t) {
  if (strand.part) number = strand.part->strand;
  const double s = on_strand(strand, t);
  return double(look.opacity) * film_at(look, strand, number, s).opacity * (1 - s * s * s);
}

std::vector<DrawnStrand> pruned(const std::vector<DrawnStrand>& strands, const Look& look) {
  const auto all = double(strands.size());
  const auto drawn = std::size_t(std::min(std::max(std::ceil(double(look.fraction) * all), 1.0), all));
  const std::size_t fading = std::max<std::size_t>(1, std::min(drawn / 8, strands.size() - drawn));
  const auto step = float(1.0 / double(fading));
  double sum = 0;
  for (std::size_t i = 0; i < drawn; ++i) sum += std::min(1.0, double(drawn - i) / double(fading));
  const auto widen = float(double(look.width_factor) * all / sum);
  std::vector<DrawnStrand> result(strands.begin(), strands.begin() + std::ptrdiff_t(drawn));
  for (std::size_t i = 0; i < drawn; ++i) result[i].width *= widen * std::min(float(drawn - i) * step, 1.0f);
  return result;
}

std::vector<Entry> drawing_order(const Camera& camera, const DepthRange& range,
                                 const std::vector<DrawnStrand>& strands, BackFacing back) {
  const auto depth = [&](glm::vec3 p) { return times(camera.row_w, p); };
  std::vector<Entry> order;
  for (std::uint32_t i = 0; i < strands.size(); ++i) {
    const DrawnStrand& strand = strands[i];
    const glm::vec3 to_eye = camera.eye - (strand.part ? strand.part->root : strand.point[0]);
    const float facing = dot_f(strand.normal, to_eye);
    const bool away = facing < 0 && facing * facing > 0.0625f * dot_f(to_eye, to_eye);
    if (away && back != BackFacing::drawn) continue;
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

std::optional<ShadowMap> shadow_map_of(const Look& look, const std::vector<DrawnStrand>& strands) {
  if (look.shadow.reading == Shadow::none) return {};
  const LightView view = light_view(look);
  return ShadowMap{view, opacity_map(look, view, strands)};
}

glm::dvec3 strand_colour(const Camera& camera, const Look& look, const std::optional<ShadowMap>& shadow,
                         const DrawnStrand& strand, std::uint32_t number, double t) {
  return StrandLight(camera, look, strand, number)
      .colour(t, part_of_key(look, shadow, curve_of(strand).at(t)));
}

Picture draw(const Camera& camera, const Look& look, const std::vector<DrawnStrand>& strands,
             const std::vector<Entry>& order, const SkinSurface* skin, std::uint64_t* fragments) {
  const std::optional<ShadowMap> shadow_map = shadow_map_of(look, strands);
  std::vector<SkinPixel> below;
  if (skin) below = skin_pixels(camera, look, *skin, shadow_map ? &*shadow_map : nullptr);
  Canvas canvas(camera.width, camera.height, std::move(below));
  for (const Entry& entry : order) {
    const std::vector<Vertex> vertices =
        vertices_of(camera, look, shadow_map, strands[entry.strand], entry.strand);
    if (!vertices.empty()) canvas.draw(vertices);
  }
  if (fragments) *fragments = canvas.fragments();
  return canvas.composed(Vec(look.background));
}

}  // namespace pelage::strands::reference
