#include "harness/topology/layout.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

namespace pelage::springs {
namespace {

constexpr std::uint32_t slice = 16, window = 256;

struct Neighbour {
  std::uint32_t stick;
  float rest;
};

std::vector<std::vector<Neighbour>> neighbours(const Topology& topology) {
  std::vector<std::vector<Neighbour>> found(topology.sticks());
  const auto shift = std::uint32_t(topology.sticks());
  for (std::size_t k = topology.sticks(); k < topology.spring.size(); ++k) {
    const glm::uvec2 ends = topology.spring[k] - shift;
    found[ends.x].push_back({ends.y, topology.rest[k]});
    found[ends.y].push_back({ends.x, topology.rest[k]});
  }
  return found;
}

// Rows by falling degree within each window.
std::vector<std::uint32_t> sorted_places(const std::vector<std::vector<Neighbour>>& around) {
  std::vector<std::uint32_t> order(around.size()), place(around.size());
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t first = 0; first < order.size(); first += window)
    std::stable_sort(order.begin() + std::ptrdiff_t(first),
                     order.begin() + std::ptrdiff_t(std::min(first + window, order.size())),
                     [&](std::uint32_t a, std::uint32_t b) { return around[a].size() > around[b].size(); });
  for (std::uint32_t row = 0; row < order.size(); ++row) place[order[row]] = row;
  return place;
}

void lay_out_springs(const std::vector<std::vector<Neighbour>>& around, Layout& layout) {
  std::vector<std::uint32_t> stick(layout.rows(), std::uint32_t(around.size()));
  for (std::uint32_t i = 0; i < around.size(); ++i) stick[layout.place[i]] = i;
  layout.start.push_back(0);
  for (std::size_t first = 0; first < layout.rows(); first += slice) {
    std::size_t longest = 0;
    for (std::size_t row = first; row < first + slice; ++row)
      if (stick[row] < around.size()) longest = std::max(longest, around[stick[row]].size());
    for (std::size_t k = 0; k < longest; ++k)
      for (std::size_t row = first; row < first + slice; ++row) {
        const bool real = stick[row] < around.size() && k < around[stick[row]].size();
        const Neighbour other = real ? around[stick[row]][k] : Neighbour{0, 0};
        layout.neighbour.push_back(std::int32_t(real ? layout.place[other.stick] : row));
        layout.rest.push_back(other.rest);
      }
    layout.start.push_back(layout.start.back() + std::int32_t(longest));
  }
}

}  // namespace

Layout lay_out(const Topology& topology, const Wind& wind) {
  Layout layout;
  const std::size_t sticks = topology.sticks();
  layout.corners = topology.kind == Kind::separable_prisms ? 3 : 1;
  const std::size_t block = slice * std::size_t(layout.corners);
  layout.blocks = int((sticks + block - 1) / block);
  layout.place.resize(sticks);
  std::iota(layout.place.begin(), layout.place.end(), 0u);
  std::vector<std::vector<Neighbour>> around;
  if (topology.kind == Kind::prisms) {
    around = neighbours(topology);
    layout.place = sorted_places(around);
  } else if (topology.kind == Kind::separable_prisms) {
    for (std::uint32_t i = 0; i < sticks; ++i)
      layout.place[i] = (i / 3 / slice * 3 + i % 3) * slice + i / 3 % slice;
    layout.side.assign(std::size_t(layout.blocks) * slice, glm::vec4(0));
    for (std::size_t e = 0; e < topology.edges().size(); ++e)
      layout.side[e / 3][int(e % 3)] = topology.rest[sticks + e];
  }

  const glm::vec4 up(0, 1, 0, 0);
  const std::size_t rows = std::size_t(layout.blocks) * block;
  layout.root.assign(rows, glm::vec4(0, 0, 0, 1));
  layout.normal.assign(rows, up);
  layout.offset.assign(rows, topology.length * up);
  const glm::dvec3 along = glm::normalize(glm::dvec3(wind.direction));
  for (std::size_t i = 0; i < sticks; ++i) {
    const double phase =
        2 * std::numbers::pi * glm::dot(glm::dvec3(topology.mass[i]), along) / double(wind.wavelength);
    const std::uint32_t row = layout.place[i];
    layout.root[row] = glm::vec4(topology.mass[i], float(std::cos(phase)));
    layout.normal[row] = glm::vec4(topology.normal[i], float(std::sin(phase)));
    layout.offset[row] = glm::vec4(topology.length * topology.normal[i], 0);
  }
  if (topology.kind == Kind::prisms) lay_out_springs(around, layout);
  return layout;
}

std::size_t memory(const Layout& layout, Solver solver) {
  constexpr std::size_t row = sizeof(glm::vec4), index = sizeof(std::int32_t);
  // Root, normal, push, offset, speed, and when a mass was lost.
  std::size_t bytes = layout.rows() * (5 * row + index) + index + layout.side.size() * row;
  if (layout.start.empty()) return bytes;
  bytes += index * (layout.start.size() + layout.neighbour.size()) + sizeof(float) * layout.rest.size();
  switch (solver) {
    case Solver::explicit_euler:
    case Solver::semi_implicit_euler:
      return bytes + layout.rows() * 3 * row;  // tips, and the next tips and speeds
    case Solver::rk4:
      return bytes + layout.rows() * 8 * row;  // and of two more stages, with the weighted rates
    case Solver::backward_euler:
      break;
  }
  return bytes + layout.rows() * 7 * row + layout.neighbour.size() * row;  // tips; x, r, d, A d; A
}

}  // namespace pelage::springs
