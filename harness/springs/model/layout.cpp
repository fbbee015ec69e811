#include "harness/springs/model/layout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pelage::springs {
namespace {

constexpr std::uint32_t slice = 16, window = 256;

struct Neighbour {
  std::uint32_t stick;
  float rest;
};

std::vector<std::vector<Neighbour>> neighbours(const SpringNetwork& network) {
  std::vector<std::vector<Neighbour>> found(network.sticks());
  const auto shift = std::uint32_t(network.sticks());
  for (std::size_t k = network.sticks(); k < network.spring.size(); ++k) {
    const glm::uvec2 ends = network.spring[k] - shift;
    found[ends.x].push_back({ends.y, network.rest[k]});
    found[ends.y].push_back({ends.x, network.rest[k]});
  }
  return found;
}

// Divides the sticks into windows of 256 consecutive sticks, and sorts the sticks of each window by
// descending number of neighbours. Returns the index of each stick in the new order of all sticks.
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
  std::vector<std::uint32_t> stick(layout.places(), std::uint32_t(around.size()));
  for (std::uint32_t i = 0; i < around.size(); ++i) stick[layout.place[i]] = i;
  layout.start.push_back(0);
  for (std::size_t first = 0; first < layout.places(); first += slice) {
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

void set3(std::vector<float>& table, std::size_t place, std::size_t columns, std::size_t first,
          glm::vec3 value) {
  for (std::size_t c = 0; c < 3; ++c) table[column_of(place, columns, first + c)] = value[int(c)];
}

}  // namespace

void set_phases(const SpringNetwork& network, const Wind& wind, Layout& layout) {
  for (std::size_t i = 0; i < network.sticks(); ++i) {
    const double phase = gust_phase(wind, network.gust_at[i]);
    layout.sites[column_of(layout.place[i], SITE_COLUMNS, SITE_PHASE_COS)] = float(std::cos(phase));
    layout.sites[column_of(layout.place[i], SITE_COLUMNS, SITE_PHASE_SIN)] = float(std::sin(phase));
  }
}

Layout lay_out(const SpringNetwork& network, const Wind& wind) {
  Layout layout;
  const std::size_t sticks = network.sticks();
  layout.corners = network.kind.own_edges() ? 3 : 1;
  layout.place.resize(sticks);
  std::iota(layout.place.begin(), layout.place.end(), 0u);
  std::size_t together = std::size_t{4} * slice;
  std::vector<std::vector<Neighbour>> around;
  if (network.kind.shared_edges()) {
    together = slice;
    around = neighbours(network);
    layout.place = sorted_places(around);
  } else if (network.kind.own_edges()) {
    together = std::size_t{3} * slice;
    for (std::uint32_t i = 0; i < sticks; ++i)
      layout.place[i] = (i / 3 / slice * 3 + i % 3) * slice + i / 3 % slice;
  }
  layout.slices = int((sticks + together - 1) / together * together / slice);

  const std::size_t places = layout.places();
  layout.sites.assign(SITE_COLUMNS * places, 0);
  layout.offset.assign(3 * places, 0);
  const auto stand = [&](std::size_t place, glm::vec3 root, glm::vec3 normal) {
    set3(layout.sites, place, SITE_COLUMNS, SITE_ROOT, root);
    set3(layout.sites, place, SITE_COLUMNS, SITE_NORMAL, normal);
    layout.sites[column_of(place, SITE_COLUMNS, SITE_PHASE_COS)] = 1;
    set3(layout.offset, place, 3, 0, network.length * normal);
  };
  for (std::size_t place = 0; place < places; ++place) stand(place, {0, 0, 0}, {0, 1, 0});
  for (std::size_t i = 0; i < sticks; ++i) stand(layout.place[i], network.mass[i], network.normal[i]);
  set_phases(network, wind, layout);
  if (network.kind.shared_edges()) lay_out_springs(around, layout);
  if (network.kind.own_edges()) {
    layout.sides.assign(places, 0);
    for (std::size_t e = 0; e < network.edges().size(); ++e)
      layout.sides[column_of(e / 3, 3, e % 3)] = network.rest[sticks + e];
  }
  return layout;
}

std::size_t memory(const Layout& layout, Solver solver) {
  // All values have 4 bytes. `columns` is the number of floats per place: SITE_COLUMNS in the buffer `sites`,
  // and 3 in each of `push`, `offset` and `speed`. `values` is the number of values in all other buffers: one
  // per place in diverged_at, one in `first`, and `sides`.
  std::size_t columns = SITE_COLUMNS + 9;
  std::size_t values = layout.places() + 1 + layout.sides.size();
  if (layout.start.empty()) return 4 * (columns * layout.places() + values);
  // The topology is prisms, which stores the speed and the position of a top in rows of four floats. Three of
  // them are already counted.
  columns += 1 + 4;
  values += layout.start.size() + layout.neighbour.size() + layout.rest.size();
  if (solver.implicit) {
    // Conjugate gradients for A x = b: position of the base, x and direction d (4 floats each), residual r
    // and product A d (3 each), and the diagonal block of A and its inverse (6 each).
    columns += 12 + 6 + 12;
    values += 3 * layout.neighbour.size();
  } else {
    columns += 8;  // tip and speed after the step, 4 floats each
    // RK4 needs one more buffer of tips and one of speeds (4 floats each), the offset at the current stage,
    // and the sums of the weighted derivatives of offset and speed (3 each).
    if (solver.multistage()) columns += 8 + 9;
  }
  return 4 * (columns * layout.places() + values);
}

}  // namespace pelage::springs
