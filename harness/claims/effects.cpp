#include "harness/claims/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "harness/base/median.hpp"
#include "harness/base/numbers.hpp"

namespace pelage::claims {
namespace {

using Axes = std::map<std::string, std::string>;
using Group = std::vector<std::size_t>;  // indices of cells

/// Returns the cell's axis value, or the claim's metric `along`, as a number; nothing if it is not above 0.
std::optional<double> position_of(const Claim& claim, const std::string& axis, const Cell& cell) {
  std::optional<double> x;
  if (!claim.along.empty()) {
    const auto& metrics = cell.processes.front()->metrics;
    if (const auto found = metrics.find(claim.along); found != metrics.end()) x = found->second.value;
  } else {
    x = number_of(value_at(cell.axes, axis));
  }
  return x && *x > 0 ? x : std::nullopt;
}

/// Returns the axes that have several values among the cells and are not in `used`.
std::vector<std::string> telling_axes(const std::vector<Cell>& cells, const std::set<std::string>& used) {
  std::map<std::string, std::set<std::string>> values;
  for (const Cell& cell : cells)
    for (const auto& [axis, value] : cell.axes) values[axis].insert(value);
  std::vector<std::string> names;
  for (const auto& [axis, found] : values)
    if (found.size() > 1 && !used.contains(axis)) names.push_back(axis);
  return names;
}

/// Divides the cells into groups with equal values of all axes that are not in `used`.
std::vector<Group> groups_of(const std::vector<Cell>& cells, const std::set<std::string>& used) {
  std::vector<Group> groups;
  std::map<Axes, std::size_t> known;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Axes axes = cells[i].axes;
    for (const std::string& axis : used) axes.erase(axis);
    const auto [place, added] = known.try_emplace(std::move(axes), groups.size());
    if (added) groups.emplace_back();
    groups[place->second].push_back(i);
  }
  return groups;
}

bool is_of(const Selection& selection, const Cell& cell) {
  return std::ranges::all_of(selection,
                             [&](const auto& one) { return value_at(cell.axes, one.first) == one.second; });
}

/// Returns the two cells of the group that Claim::of and Claim::to select. If one of them is missing or
/// several cells are selected, returns nothing and adds the reason to `left_out`; no reason if both are
/// missing.
std::optional<std::pair<std::size_t, std::size_t>> pair_of(const Claim& claim, const std::vector<Cell>& cells,
                                                           const Group& group,
                                                           std::vector<std::string>& left_out) {
  Group of, to;
  for (const std::size_t i : group) {
    if (is_of(claim.of, cells[i])) of.push_back(i);
    if (is_of(claim.to, cells[i])) to.push_back(i);
  }
  if (of.size() == 1 && to.size() == 1) return std::pair(of.front(), to.front());
  if (std::max(of.size(), to.size()) > 1)
    left_out.push_back(
        fmt::format("{} (several cases differ only in their names, so the claim cannot select one)",
                    cells[group.front()].name));
  else if (of.size() != to.size())
    left_out.push_back(fmt::format("{} (there is no matching case with {})",
                                   cells[of.empty() ? to.front() : of.front()].name,
                                   text_of(of.empty() ? claim.of : claim.to)));
  return {};
}

/// Adds the part whose effect is a slope: of the quantity against the claim's axis, or for ratio_trend of the
/// ratio against the axis `across`.
void add_slope(const Claim& claim, const std::vector<Cell>& cells, const Group& group, Part part,
               std::vector<Part>& parts, std::vector<std::string>& left_out) {
  const bool trend = claim.effect == Effect::ratio_trend;
  const std::string& axis = trend ? claim.across : claim.axis;
  std::vector<std::pair<double, Group>> points;  // x, and the cells with this value
  const auto add = [&](const Group& at_one_x) {
    const Cell& cell = cells[at_one_x.front()];
    const auto x = position_of(claim, axis, cell);
    if (x)
      points.emplace_back(*x, at_one_x);
    else
      left_out.push_back(fmt::format("{} (its {} is not a number above 0)", cell.name,
                                     claim.along.empty() ? axis : claim.along));
  };
  if (trend) {
    std::map<std::string, Group> at;  // value of the axis `across` -> indices of cells
    for (const std::size_t i : group) at[value_at(cells[i].axes, axis)].push_back(i);
    for (const auto& [value, members] : at)
      if (const auto pair = pair_of(claim, cells, members, left_out)) add({pair->first, pair->second});
  } else {
    for (const std::size_t i : group) add({i});
  }
  std::ranges::sort(points);
  for (const auto& [x, at_one_x] : points) {
    part.x.push_back(x);
    part.cells.insert(part.cells.end(), at_one_x.begin(), at_one_x.end());
  }
  if (points.size() >= claim.values && std::ranges::adjacent_find(part.x) == part.x.end())
    parts.push_back(std::move(part));
  else
    left_out.push_back(fmt::format("{} (the effect needs {} different values of {})",
                                   cells[group.front()].name, claim.values, axis));
}

/// Returns the slope of the least-squares line through (ln x, y).
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0, mean_y = 0, xy = 0, xx = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += std::log(x[i]) / double(x.size());
    mean_y += y[i] / double(x.size());
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = std::log(x[i]) - mean_x;
    xy += dx * (y[i] - mean_y);
    xx += dx * dx;
  }
  return xy / xx;
}

}  // namespace

std::vector<Part> parts_of(const Claim& claim, const std::vector<Cell>& cells,
                           std::vector<std::string>& left_out) {
  std::vector<Part> parts;
  if (cells.empty()) return parts;
  if (claim.effect == Effect::level) {
    for (std::size_t i = 0; i < cells.size(); ++i) parts.push_back({cells[i].name, {i}, {}});
    return parts;
  }
  if (claim.effect == Effect::share_of_cases) {
    Part all;
    all.cells.resize(cells.size());
    std::iota(all.cells.begin(), all.cells.end(), std::size_t(0));
    return {all};
  }
  std::set<std::string> used{claim.axis, claim.across};
  for (const Selection* selection : {&claim.of, &claim.to})
    for (const auto& [axis, value] : *selection) used.insert(axis);
  const std::vector<std::string> telling = telling_axes(cells, used);
  for (const Group& group : groups_of(cells, used)) {
    Part part;
    for (const std::string& axis : telling) {
      if (!part.name.empty()) part.name += ' ';
      part.name += value_at(cells[group.front()].axes, axis);
    }
    if (claim.effect == Effect::ratio_trend || claim.effect == Effect::elasticity ||
        claim.effect == Effect::linearity) {
      add_slope(claim, cells, group, std::move(part), parts, left_out);
    } else if (const auto pair = pair_of(claim, cells, group, left_out)) {
      part.cells = {pair->first, pair->second};
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

double effect_of(const Claim& claim, const Part& part, const std::vector<Value>& values) {
  const auto value = [&](std::size_t i) { return values[part.cells[i]].value; };
  switch (claim.effect) {
    case Effect::level:
      break;
    case Effect::ratio:
      return value(0) / value(1);
    case Effect::ratio_by_phase:
      return 1 + (value(0) - value(1)) / values[part.cells[1]].frame;
    case Effect::elasticity: {
      std::vector<double> y;
      for (const std::size_t i : part.cells) y.push_back(std::log(values[i].value));
      return slope(part.x, y);
    }
    case Effect::linearity: {
      const std::size_t last = part.cells.size() - 1, middle = part.cells.size() / 2;
      const double upper = (value(last) - value(middle)) / (part.x[last] - part.x[middle]);
      return upper / ((value(middle) - value(0)) / (part.x[middle] - part.x[0]));
    }
    case Effect::ratio_trend: {
      std::vector<double> y;
      for (std::size_t i = 0; i < part.x.size(); ++i) y.push_back(std::log(value(2 * i) / value(2 * i + 1)));
      return slope(part.x, y);
    }
    case Effect::share_of_cases:
      return double(std::count_if(part.cells.begin(), part.cells.end(),
                                  [&](std::size_t i) { return values[i].value >= claim.threshold; })) /
             double(part.cells.size());
  }
  return value(0);
}

double combined(const Claim& claim, const std::vector<double>& effects) {
  if (claim.combine == Combine::median) return median(effects);
  if (claim.combine == Combine::geometric_mean) return geometric_mean(effects);
  return std::accumulate(effects.begin(), effects.end(), 0.0) / double(effects.size());
}

}  // namespace pelage::claims
