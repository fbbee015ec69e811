#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numeric>
#include <optional>

#include "harness/error.hpp"
#include "harness/mesh/sides.hpp"
#include "harness/mesh/unfold.hpp"
#include "harness/mesh/uv_pieces.hpp"

namespace pelage {
namespace {

using Shape = std::vector<Surface::Corners>;  // UV of the triangles of a piece
constexpr double most_stretch = 1.6;          // of areas, with `even`
constexpr double least_scale = 0.5;           // a map that would become smaller than this stays as it is

double surface_area(const Surface& surface, const Faces& faces) {
  return std::accumulate(faces.begin(), faces.end(), 0.0,
                         [&](double sum, std::uint32_t f) { return sum + surface_area(surface, f); });
}

double uv_area(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), 0.0, [](double sum, const Surface::Corners& corners) {
    return sum + 0.5 * std::abs(twice_uv_area(corners));
  });
}

bool is_clean(const Shape& shape) {
  return std::ranges::all_of(shape, [](const auto& corners) { return twice_uv_area(corners) > 0; }) &&
         uv_overlaps(shape).empty();
}

/// Returns the triangles of a piece as a surface. Two corners are one point of it if a chain of triangles
/// around this point, each the neighbour of the next, connects them.
Surface separate(const Surface& surface, const Faces& faces, const Neighbours& next) {
  Groups groups(faces.size() * 3);
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const auto& t = surface.triangle[faces[i]];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto there = std::lower_bound(faces.begin(), faces.end(), next[faces[i]][k]);
      if (there == faces.end() || *there != next[faces[i]][k]) continue;
      const auto j = std::uint32_t(there - faces.begin());
      const auto& o = surface.triangle[*there];
      for (const std::uint32_t corner : {k, (k + 1) % 3}) {
        const auto same = std::uint32_t(std::find(o.begin(), o.end(), t[corner]) - o.begin());
        groups.join(3 * i + corner, 3 * j + same);
      }
    }
  }
  Surface piece;
  const std::vector<std::uint32_t> number = groups.numbers();
  piece.triangle.resize(faces.size());
  for (std::uint32_t c = 0; c < number.size(); ++c) {
    if (number[c] == piece.point.size())
      piece.point.push_back(surface.point[surface.triangle[faces[c / 3]][c % 3]]);
    piece.triangle[c / 3][c % 3] = number[c];
  }
  return piece;
}

/// Returns a plan that cuts a piece from its border to its innermost point.
CutPlan slit(const Surface& piece) {
  CutPlan plan{piece.point.front(), {}};
  const Neighbours next = neighbours_of(piece, false);
  std::vector<glm::dvec3> border;
  for (std::size_t f = 0; f < next.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      if (next[f][k] == no_face) border.push_back(piece.point[piece.triangle[f][k]]);
  if (border.empty()) return plan;
  const glm::dvec3 innermost = farthest_from_cut(piece, plan, border).point;
  const auto distance = [&](const glm::dvec3& p) { return glm::distance(p, innermost); };
  plan.tips = {*std::ranges::min_element(border, {}, distance), innermost};
  return plan;
}

/// Flattens a piece. Returns nothing if the map overlaps or if no map can be made.
std::optional<Shape> flattened(const Surface& surface, const Faces& faces, const Neighbours& next,
                               int iterations, bool with_slit, const std::string& name) {
  const Surface piece = separate(surface, faces, next);
  try {
    const Disk disk = cut_open(piece, with_slit ? slit(piece) : CutPlan{piece.point.front(), {}});
    const FlatDisk flat = flatten(piece, disk, name, {}, iterations);
    Shape shape;
    for (const auto& [a, b, c] : disk.triangle) shape.push_back({flat.uv[a], flat.uv[b], flat.uv[c]});
    if (is_clean(shape)) return shape;
  } catch (const InputError&) {  // another way of flattening may succeed
  }
  return {};
}

/// A part of the surface and its UV, scaled and rotated by laid().
struct OwnChart {
  Faces faces;
  Shape shape;         ///< its bounding box starts at (0, 0)
  glm::dvec2 size{0};  ///< of the bounding box
};

/// Scales a shape by `scale` and rotates it such that the area of its bounding box is smallest.
OwnChart laid(const Faces& faces, const Shape& shape, double scale) {
  OwnChart best{faces, {}, {}};
  double least = std::numeric_limits<double>::max();
  for (int degrees = 0; degrees < 90; degrees += 3) {
    const double c = scale * std::cos(glm::radians(double(degrees))),
                 s = scale * std::sin(glm::radians(double(degrees)));
    Shape turned = shape;
    glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
    for (auto& corners : turned)
      for (glm::dvec2& p : corners) {
        p = {c * p.x - s * p.y, s * p.x + c * p.y};
        low = glm::min(low, p), high = glm::max(high, p);
      }
    const glm::dvec2 size = high - low;
    if (size.x * size.y >= least * (1 - 1e-6)) continue;
    least = size.x * size.y;
    for (auto& corners : turned)
      for (glm::dvec2& p : corners) p -= low;
    best.shape = std::move(turned), best.size = size;
  }
  return best;
}

/// Returns the share of a part's surface area on which the ratio of UV area to surface area is more than
/// `factor` times larger or smaller than on the whole part.
double stretched_share(const Surface& surface, const Faces& faces, const Shape& shape, double factor) {
  const double area = surface_area(surface, faces), ratio = uv_area(shape) / area;
  double sum = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double own = surface_area(surface, faces[i]), uv = 0.5 * std::abs(twice_uv_area(shape[i]));
    if (uv > factor * ratio * own || factor * uv < ratio * own) sum += own;
  }
  return sum / area;
}

/// Gives UV maps without overlaps to the pieces that choose_pieces() cuts out.
class Flattener {
 public:
  /// `per_uv` is the length on the surface per unit of UV, in the whole map.
  Flattener(const Surface& surface, const PieceRules& rules, double per_uv, const std::string& name)
      : surface_(surface), rules_{rules.growth, 0}, per_uv_(per_uv), name_(name) {}

  /// Appends the charts of a piece. With `anew`, the piece is flattened even if its present UV has no
  /// overlaps.
  void add(const Faces& faces, bool anew, std::vector<OwnChart>& charts) const {
    Shape present;
    for (const std::uint32_t f : faces) present.push_back(surface_.uv[f]);
    const bool clean = is_clean(present);
    std::optional<OwnChart> chart;
    if (anew) chart = flattened(faces, even, false);
    if (anew && !chart) chart = flattened(faces, even, true);
    if (!clean && !chart) chart = flattened(faces, usual, false);
    if (!chart && clean) chart = chart_of(faces, present);
    if (!chart && divide(faces, charts)) return;
    if (!chart) chart = flattened(faces, lenient, false);
    charts.push_back(chart ? std::move(*chart) : chart_of(faces, present));
  }

 private:
  /// On at most `share` of a piece, the scale of areas may differ from its mean by more than `factor`.
  struct Limits {
    double factor, share;
    int least_iterations;
  };
  static constexpr Limits even{1.5, 0.1, 1}, usual{2.5, 0.02, 1}, lenient{2.5, 1, 0};
  static constexpr double most_side = 0.9;  // of a chart's bounding box, in UV

  OwnChart chart_of(const Faces& faces, const Shape& shape) const {
    return laid(faces, shape, std::sqrt(surface_area(surface_, faces) / uv_area(shape)) / per_uv_);
  }

  /// Flattens a piece as rigidly as possible without overlaps. Seams inside the piece are closed, except if
  /// only open seams permit a map. Returns nothing if there is no such map within the limits, or if its
  /// bounding box is too large.
  std::optional<OwnChart> flattened(const Faces& faces, const Limits& limits, bool with_slit) const {
    for (const int iterations : {most_rigid, 5, 3, 2, 1, 0})
      for (const Neighbours* next : {&on_surface_, &in_uv_}) {
        if (iterations < limits.least_iterations) continue;
        const auto shape = pelage::flattened(surface_, faces, *next, iterations, with_slit, name_);
        if (!shape || stretched_share(surface_, faces, *shape, limits.factor) > limits.share) continue;
        OwnChart chart = chart_of(faces, *shape);
        if (std::max(chart.size.x, chart.size.y) <= most_side) return chart;
      }
    return {};
  }

  /// Divides a piece whose UV overlaps. Returns false if this is not possible.
  bool divide(const Faces& faces, std::vector<OwnChart>& charts) const {
    Surface part;
    part.point = surface_.point;
    for (const std::uint32_t f : faces)
      part.triangle.push_back(surface_.triangle[f]), part.uv.push_back(surface_.uv[f]);
    Pieces pieces = choose_pieces(part, rules_);
    if (pieces.rest.empty()) return false;
    for (auto* list : {&pieces.rest, &pieces.piece})
      for (Faces& piece : *list) {
        for (std::uint32_t& f : piece) f = faces[f];
        add(piece, false, charts);
      }
    return true;
  }

  const Surface& surface_;
  PieceRules rules_;
  double per_uv_;
  const std::string& name_;
  Neighbours on_surface_ = neighbours_of(surface_, false), in_uv_ = neighbours_of(surface_, true);
};

/// Makes the map smaller. The lower left corner of the space inside the margin stays in its place.
glm::dvec2 smaller(glm::dvec2 p, double scale) {
  constexpr double margin = 2.0 / 256;
  return margin + scale * (p - margin);
}

/// Finds places for the charts beside the triangles that are kept, if both are made smaller by `scale`.
/// Returns an empty list if there is not enough space.
std::vector<glm::dvec2> places(const Surface& surface, const std::vector<char>& kept,
                               const std::vector<OwnChart>& charts, double scale) {
  FreeSpace space;
  for (std::size_t f = 0; f < kept.size(); ++f) {
    Surface::Corners corners = surface.uv[f];
    for (glm::dvec2& p : corners) p = smaller(p, scale);
    if (kept[f]) space.take(corners);
  }
  std::vector<glm::dvec2> list;
  for (const OwnChart& chart : charts) {
    const auto there = space.place(scale * chart.size);
    if (!there) return {};
    list.push_back(*there);
  }
  return list;
}

/// Places the charts and writes their UV. Returns false if there is not enough space.
bool place(Surface& surface, const std::vector<char>& kept, std::vector<OwnChart>& charts) {
  std::ranges::stable_sort(charts, std::ranges::greater(),
                           [](const OwnChart& chart) { return chart.size.x * chart.size.y; });
  double scale = 1;
  std::vector<glm::dvec2> list = places(surface, kept, charts, scale);
  while (list.empty() && scale > least_scale) list = places(surface, kept, charts, scale *= 0.95);
  if (list.empty()) return false;
  if (scale < 1)
    for (auto& corners : surface.uv)
      for (glm::dvec2& p : corners) p = smaller(p, scale);
  for (std::size_t i = 0; i < charts.size(); ++i)
    for (std::size_t f = 0; f < charts[i].faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        surface.uv[charts[i].faces[f]][k] = list[i] + scale * charts[i].shape[f][k];
  return true;
}

}  // namespace

bool recut(Surface& surface, bool even, const std::string& name) {
  Faces all(surface.triangle.size());
  std::iota(all.begin(), all.end(), 0u);
  const double per_uv = std::sqrt(surface_area(surface, all) / uv_area(surface.uv));
  // The growth is three texels of a wetness mask of 256 x 256 texels.
  const PieceRules rules{3.0 / 256 * per_uv, even ? most_stretch : 0.0};
  const Pieces pieces = choose_pieces(surface, rules);
  if (pieces.piece.empty()) return false;
  const Flattener flattener(surface, rules, per_uv, name);
  std::vector<OwnChart> charts;
  for (const Faces& faces : pieces.piece) flattener.add(faces, even, charts);
  std::vector<char> kept(surface.triangle.size(), false);
  for (const Faces& faces : pieces.rest)
    for (const std::uint32_t f : faces) kept[f] = true;
  if (!place(surface, kept, charts)) {
    surface.notes.push_back(fmt::format(
        "UV map: {} parts would need charts of their own, but the UV square has no space for them",
        charts.size()));
    return true;
  }
  surface.packed_uv = true;
  surface.notes.push_back(fmt::format("UV map: {} part{} cut out, because the map overlapped itself{}",
                                      charts.size(), charts.size() == 1 ? " was" : "s were",
                                      even ? " or was stretched" : ""));
  return true;
}

}  // namespace pelage
