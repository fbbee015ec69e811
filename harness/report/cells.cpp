#include "harness/report/cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace pelage {
namespace {

std::string text(const Row& row, const char* key) {
  const auto found = row.provenance.find(key);
  return found != row.provenance.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

Cell cell_of(const FoundRow& found) {
  const Row& row = found.row;
  Cell cell;
  cell.experiment = row.experiment;
  cell.case_name = row.case_name;
  cell.variant = row.variant;
  cell.device = row.device;
  cell.host = text(row, "host");
  cell.axes = row.axes;
  cell.overrides = row.overrides;
  cell.identity = row.identity;
  cell.metrics = row.metrics;
  cell.image = picture_of(found);
  return cell;
}

/// Returns the names of a cell. Cells with the same names may have different identities.
auto names(const Cell& c) {
  return std::tie(c.experiment, c.case_name, c.variant, c.device, c.host, c.overrides);
}

void add(Cell& cell, const Row& row) {
  if (row.status != Status::ok && cell.status == Status::ok) {
    cell.status = row.status;
    cell.reason = row.reason;
  }
  cell.converged = cell.converged && row.provenance.value("converged", false);
  if (std::vector<double> times = frame_ms(row); !times.empty()) cell.processes.push_back(std::move(times));
}

void summarize(Cell& cell) {
  if (cell.status != Status::ok || cell.processes.empty()) return;
  std::vector<double> pooled;
  for (const auto& process : cell.processes) pooled.insert(pooled.end(), process.begin(), process.end());
  cell.median_ms = median(pooled);
  cell.interval_ms = nested_median_interval(cell.processes, 1);
}

}  // namespace

std::string Cell::axis(const std::string& key) const {
  const auto found = axes.find(key);
  return found == axes.end() ? std::string{} : found->second;
}

std::string Cell::reading() const {
  const std::string value = axis("reading");
  return value.empty() ? "default" : value;
}

std::optional<Metric> Cell::paper_fps() const {
  const auto found = metrics.find("paper_fps");
  if (found == metrics.end()) return {};
  return found->second;
}

std::vector<Cell> cells_of(const std::vector<FoundRow>& rows) {
  std::vector<Cell> cells;
  for (const FoundRow& found : rows) {
    Cell cell = cell_of(found);
    auto place = std::find_if(cells.begin(), cells.end(), [&](const Cell& c) {
      return names(c) == names(cell) && c.identity == cell.identity;
    });
    if (place == cells.end()) place = cells.insert(place, std::move(cell));
    add(*place, found.row);
  }
  for (Cell& cell : cells) summarize(cell);
  std::stable_sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
    return std::tie(a.experiment, a.device, a.host) < std::tie(b.experiment, b.device, b.host);
  });
  return cells;
}

std::optional<Ratio> ratio_of(const Cell& cell) {
  const std::optional<Metric> paper = cell.paper_fps();
  if (!paper || cell.median_ms <= 0) return {};
  Ratio ratio{cell.fps() / paper->value, paper->relation == "<" ? ">" : "", {}, {}};
  if (paper->high) ratio.low = 1000 / cell.interval_ms.high / *paper->high;
  if (paper->low && *paper->low > 0) ratio.high = 1000 / cell.interval_ms.low / *paper->low;
  return ratio;
}

std::string published_text(const Metric& figure) {
  if (figure.relation == "<") return fmt::format("< {:g}", figure.value);
  if (figure.relation == "about") return fmt::format("~ {:g}", figure.value);
  if (figure.relation == "range" && figure.low && figure.high)
    return fmt::format("{:g}..{:g}", *figure.low, *figure.high);
  return fmt::format("{:g}", figure.value);
}

}  // namespace pelage
