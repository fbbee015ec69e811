// The fur of strands of a file: their chains, and the curves between the points of each.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "harness/prepare/coat.hpp"
#include "harness/prepare/random.hpp"
#include "harness/strands/groom/fur.hpp"
#include "harness/strands/groom/steps.hpp"

namespace pelage::strands {
namespace {

using Vec = glm::dvec3;

constexpr std::uint32_t file_order_stream = 75, file_brightness_stream = 76;  // of Random
constexpr double least_chain = 1e-4, most_chain = 10;  // R, the limits of Chain::length
constexpr double least_width = 1e-6;                   // R
constexpr double least_rise = 1e-5;                    // its rounded values are not below the skin

/// Returns the unit vector v, turned into the plane with the normal n if it points below it.
Vec not_below(Vec v, Vec n) {
  const double rise = glm::dot(v, n);
  if (rise >= least_rise) return v;
  Vec flat = v - rise * n;
  if (!(glm::length(flat) > 1e-6)) flat = glm::cross(n, std::abs(n.x) < 0.9 ? Vec(1, 0, 0) : Vec(0, 1, 0));
  return glm::normalize(glm::normalize(flat) + least_rise * n);
}

/// A strand of the file.
class FileStrand {
 public:
  FileStrand(const PlacedStrands& placed, std::size_t number, std::size_t first)
      : lines_(placed.lines), first_(first), count_(placed.lines.count[number]) {
    arc_.push_back(0);
    for (std::size_t k = 1; k < count_; ++k) arc_.push_back(arc_.back() + glm::distance(at(k - 1), at(k)));
    const Vec chord = at(count_ - 1) - at(0), normal(placed.normal[number]);
    const double distance = glm::length(chord);
    length_ = std::clamp(std::max(distance, arc_.back() / 2), least_chain, most_chain);
    rest_ = not_below(distance > 1e-3 * length_ ? chord / distance : normal, normal);
  }

  std::size_t count() const { return count_; }
  Vec at(std::size_t k) const { return Vec(lines_.point[first_ + k]); }
  double length() const { return length_; }  ///< of the chain, R
  Vec rest() const { return rest_; }
  /// The place of point k on the strand, from 0 to 1.
  double place(std::size_t k) const {
    return arc_.back() > 0 ? arc_[k] / arc_.back() : double(k) / double(count_ - 1);
  }
  double width(std::size_t k, double otherwise) const {
    return lines_.width.empty() ? otherwise : double(lines_.width[first_ + k]);
  }
  /// The colour at point k, or `otherwise` if the file has no colours.
  Vec colour(std::size_t k, Vec otherwise) const {
    return lines_.colour.empty() ? otherwise : Vec(lines_.colour[first_ + k]);
  }

 private:
  const Polylines& lines_;
  std::size_t first_, count_;
  std::vector<double> arc_;  ///< lengths from the root
  double length_ = 0;
  Vec rest_{0};
};

/// A curve of a strand: control points, their places, widths at both ends, and the point with its colour.
struct PartCurve {
  std::array<Vec, 3> point;
  double from, to, width_from, width_to;
  std::size_t colour;
};

/// The points of the strand are the control points of a quadratic B-spline that ends at the first and at the
/// last of them. Returns its curves: one for two or three points, otherwise two less than there are points.
std::vector<PartCurve> curves_of(const FileStrand& strand, double width) {
  const std::size_t last = strand.count() - 1;
  const auto w = [&](std::size_t k) { return strand.width(k, width); };
  if (last == 1) {
    const Vec a = strand.at(0), b = strand.at(1);
    return {{{a, 0.5 * (a + b), b}, 0, 1, w(0), w(1), 0}};
  }
  std::vector<PartCurve> curves;
  for (std::size_t k = 1; k < last; ++k) {
    // The curve of point k goes from the middle before it to the middle behind it.
    const auto before = [&](const auto& value) {
      return k == 1 ? value(0) : 0.5 * (value(k - 1) + value(k));
    };
    const auto behind = [&](const auto& value) {
      return k + 1 == last ? value(last) : 0.5 * (value(k) + value(k + 1));
    };
    const auto at = [&](std::size_t i) { return strand.at(i); };
    const auto place = [&](std::size_t i) { return strand.place(i); };
    const double from = before(place), to = behind(place);
    if (!(float(from) < float(to))) continue;  // points that are too near each other
    curves.push_back({{before(at), strand.at(k), behind(at)}, from, to, before(w), behind(w), k});
  }
  return curves;
}

std::uint8_t byte_of_colour(double value) {
  return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

void add_strand(const FileStrand& strand, const StrandLayerScene& layer, float first_segment,
                glm::vec3 normal, Vec colour, double brightness, Fur& fur, std::vector<StrandShape>& shapes) {
  const auto key = std::uint32_t(fur.keys.size());
  KeyStrand& k = fur.keys.emplace_back();
  k.root = glm::vec3(strand.at(0));
  k.normal = normal;
  k.first = k.second = k.rest = glm::vec3(strand.rest());
  Chain& chain = fur.chains.emplace_back();
  chain.root = k.root;
  chain.rest = k.rest;
  chain.normal = normal;
  chain.length = float(strand.length());
  chain.stiffness_first = chain.stiffness_second = layer.stiffness;
  chain.limit_first = chain.limit_second = layer.limit;
  chain.drag = layer.drag;
  chain.damping = layer.damping;
  const Vec whole = double(chain.length) * Vec(k.rest);
  for (const PartCurve& part : curves_of(strand, double(layer.width))) {
    KeyedStrand& s = fur.strands.emplace_back();
    s.key = {key, key, key};
    s.length = chain.length;
    const double start = std::max(part.width_from, least_width), end = std::max(part.width_to, least_width);
    s.width = float(start);
    s.response = layer.response;
    const Vec own = strand.colour(part.colour, brightness * colour) * Vec(layer.colour);
    for (int c = 0; c < 3; ++c) s.colour[std::size_t(c)] = byte_of_colour(own[c]);
    StrandShape& shape = shapes.emplace_back();
    shape.from = float(part.from);
    shape.to = float(part.to);
    shape.width_end = float(end / start);
    const std::array<double, 3> place{double(shape.from), double(shape.middle()), double(shape.to)};
    for (std::size_t i = 0; i < 3; ++i) {
      const double t = place[i];
      const Vec straight = Vec(k.root) + (2 * t * (1 - t) * double(first_segment) + t * t) * whole;
      shape.offset[i] = glm::vec3(part.point[i] - straight);
    }
  }
}

}  // namespace

Fur fur_of_file(const PlacedStrands& placed, const StrandsScene& strands, const CoatTexture& coat) {
  const StrandLayerScene& layer = strands.layers.front();
  const Polylines& lines = placed.lines;
  const std::vector<std::size_t> first = first_points(lines);
  const Random order(layer.seed, file_order_stream), brightness(layer.seed, file_brightness_stream);
  std::vector<float> place;
  for (std::size_t i = 0; i < first.size(); ++i) place.push_back(float(order.uniform(i)));
  Fur fur;
  std::vector<StrandShape> shapes;
  for (const std::uint32_t i : prefix_order(place, placed.triangle)) {
    const double bright = 1 + double(layer.colour_spread) * brightness.symmetric(i);
    add_strand(FileStrand(placed, i, first[i]), layer, strands.chain.first_segment, placed.normal[i],
               coat_colour(coat, glm::dvec2(placed.uv[i])), bright, fur, shapes);
  }
  LayerBounds& bounds = fur.bounds.emplace_back(LayerBounds{lines.point.front(), lines.point.front()});
  for (const glm::vec3& p : lines.point) {
    bounds.low = glm::min(bounds.low, p);
    bounds.high = glm::max(bounds.high, p);
  }
  fur.shapes = std::make_shared<const std::vector<StrandShape>>(std::move(shapes));
  add_film(strands.layers, fur);
  set_chains(fur, strands.chain);
  return fur;
}

}  // namespace pelage::strands
