#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "harness/mesh/finish.hpp"
#include "harness/mesh/sides.hpp"
#include "harness/mesh/steps.hpp"
#include "harness/mesh/uv_pieces.hpp"

namespace pelage {
namespace {

std::size_t count_of(const std::vector<std::uint32_t>& component) {
  return component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + std::size_t(1);
}

// Size, rotation and placement of a chart.
struct Chart {
  double degrees = 0;   // rotation of the chart
  glm::dvec2 low{0};    // lower corner of the rotated chart's bounding box, before scaling
  glm::dvec2 size{0};   // size of the rotated chart's bounding box, after scaling and without margins
  glm::dvec2 place{0};  // position of the bounding box's lower corner in the packed UV map
  double scale;         // ratio of lengths on the surface to lengths in the chart
};

// Finds the rotation of a chart that minimizes the area of its bounding box. The function considers only
// rotations with a bounding box that is at least as wide as high.
Chart measured(const Surface& part) {
  double area = 0, uv_area = 0;
  for (std::uint32_t f = 0; f < part.triangle.size(); ++f) {
    area += surface_area(part, f);
    uv_area += 0.5 * std::abs(twice_uv_area(part.uv[f]));
  }
  Chart chart{.scale = std::sqrt(area / uv_area)};
  double least = std::numeric_limits<double>::max();
  for (double degrees = 0; degrees < 180; degrees += 3) {
    glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
    const UvTurn turn(degrees);
    for (const auto& corners : part.uv) {
      for (const glm::dvec2& p : corners) {
        const glm::dvec2 q = turn(p);
        low = glm::min(low, q), high = glm::max(high, q);
      }
    }
    const glm::dvec2 size = high - low;
    if (size.x < size.y || size.x * size.y >= least * (1 - 1e-6)) continue;
    least = size.x * size.y;
    chart.degrees = degrees, chart.low = low, chart.size = size * chart.scale;
  }
  return chart;
}

// Packs the charts in the given order into rows of at most `width`. Returns the side length of the smallest
// square that contains all rows. `gap` is the margin around a chart.
double shelve(std::vector<Chart>& charts, const std::vector<std::size_t>& order, double width, double gap) {
  double x = 0, y = 0, shelf = 0, widest = 0;
  for (const std::size_t i : order) {
    const glm::dvec2 size = charts[i].size + glm::dvec2(2 * gap);
    if (x + size.x > width) y += shelf, x = 0, shelf = 0;
    charts[i].place = glm::dvec2(x, y) + gap;
    x += size.x;
    shelf = std::max(shelf, size.y), widest = std::max(widest, x);
  }
  return std::max(widest, y + shelf);
}

// Packs the charts for many row widths and keeps the packing that needs the smallest square. Returns the side
// length of this square. The margin around a chart is a fixed fraction of this side length, and the side
// length depends on the margin. The packing is therefore repeated, at most 12 times, until the side length
// changes by less than 0.1%.
double pack(std::vector<Chart>& charts) {
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return charts[i].size.y; });
  double area = 0, widest = 0;
  for (const Chart& chart : charts)
    area += chart.size.x * chart.size.y, widest = std::max(widest, chart.size.x);
  const double share = std::min(2.0 / 256, 0.1 / std::sqrt(double(charts.size())));
  double side = std::sqrt(area);
  for (int round = 0; round < 12; ++round) {
    const double gap = share * side;
    double best = std::numeric_limits<double>::max(), width = 0;
    for (double w = std::max(widest + 2 * gap, 0.5 * side); w < 4 * side + 2 * widest; w *= 1.02)
      if (const double there = shelve(charts, order, w, gap); there < best) best = there, width = w;
    shelve(charts, order, width, gap);
    const bool settled = std::abs(best - side) < 1e-3 * side;
    side = best;
    if (settled) break;
  }
  return side;
}

}  // namespace

std::vector<std::uint32_t> components(const Surface& surface) {
  Groups groups(surface.point.size());
  for (const auto& [a, b, c] : surface.triangle) groups.join(a, b), groups.join(b, c);
  std::vector<std::uint32_t> number(surface.point.size(), no_index), component;
  component.reserve(surface.triangle.size());
  std::uint32_t next = 0;
  for (const auto& t : surface.triangle) {
    std::uint32_t& n = number[groups.find(t.front())];
    if (n == no_index) n = next++;
    component.push_back(n);
  }
  return component;
}

void turn_outwards(Surface& surface) {
  const std::vector<std::uint32_t> component = components(surface);
  const std::size_t count = count_of(component);
  const auto sides = directed_sides(surface.triangle);
  std::vector<double> volume(count, 0);  // infinite if the component is open
  std::vector<glm::dvec3> origin(count, glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
  for (std::size_t f = 0; f < surface.triangle.size(); ++f) {
    const auto& [a, b, c] = surface.triangle[f];
    const std::uint32_t n = component[f];
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      if (!std::binary_search(sides.begin(), sides.end(), std::pair(q, p)))
        volume[n] = std::numeric_limits<double>::infinity();
    if (std::isnan(origin[n].x)) origin[n] = surface.point[a];
    const glm::dvec3 o = origin[n];
    volume[n] += glm::dot(surface.point[a] - o, glm::cross(surface.point[b] - o, surface.point[c] - o));
  }
  const auto inside_out = [](double of_component) { return of_component < 0; };
  const auto turned = std::ranges::count_if(volume, inside_out);
  if (turned == 0) return;
  for (std::size_t f = 0; f < surface.triangle.size(); ++f)
    if (inside_out(volume[component[f]])) {
      std::swap(surface.triangle[f][1], surface.triangle[f][2]);
      if (!surface.uv.empty()) std::swap(surface.uv[f][1], surface.uv[f][2]);
    }
  surface.notes.push_back(count == 1 ? "turned all faces outwards"
                                     : fmt::format("turned the faces of {} components outwards", turned));
}

std::vector<Surface> split(const Surface& surface) {
  const std::vector<std::uint32_t> component = components(surface);
  std::vector<Surface> parts(count_of(component));
  std::vector<std::uint32_t> number(surface.point.size(), no_index);
  for (std::size_t f = 0; f < surface.triangle.size(); ++f) {
    Surface& part = parts[component[f]];
    Surface::Triangle t = surface.triangle[f];
    for (std::uint32_t& p : t) {
      if (number[p] == no_index) {
        number[p] = std::uint32_t(part.point.size());
        part.point.push_back(surface.point[p]);
      }
      p = number[p];
    }
    part.triangle.push_back(t);
  }
  return parts;
}

Surface packed(const Surface& surface, const std::vector<Surface>& parts) {
  std::vector<Chart> charts;
  charts.reserve(parts.size());
  for (const Surface& part : parts) charts.push_back(measured(part));
  const double side = pack(charts);
  const std::vector<std::uint32_t> component = components(surface);
  Surface result = surface;
  result.packed_uv = true;
  result.uv.clear();
  result.uv.reserve(surface.triangle.size());
  std::vector<std::size_t> next(parts.size(), 0);
  for (const std::uint32_t n : component) {
    const Chart& chart = charts[n];
    const UvTurn turn(chart.degrees);
    Surface::Corners corners = parts[n].uv[next[n]++];
    for (glm::dvec2& p : corners) p = (chart.place + chart.scale * (turn(p) - chart.low)) / side;
    result.uv.push_back(corners);
  }
  result.notes.push_back(
      fmt::format("UV map: {} components, {} charts side by side", parts.size(), parts.size()));
  return result;
}

}  // namespace pelage
