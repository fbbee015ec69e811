#include "harness/report/cells.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>

#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/measure/interruptions.hpp"

namespace pelage {
namespace {

/// Combines the values of one metric from separate processes. If all values are equal (counts, printed
/// numbers), or if one is not finite, returns the first metric. Otherwise returns the median with limits:
/// with three or more processes, mean_interval(); with two, the smaller of the two lower limits and the
/// larger of the two upper limits, if both have limits.
Metric combined_metric(std::span<const Metric> values) {
  Metric result = values.front();
  std::vector<double> numbers;
  std::ranges::transform(values, std::back_inserter(numbers), &Metric::value);
  const bool equal = std::ranges::all_of(numbers, [&](double v) { return v == result.value; });
  const bool finite = std::ranges::all_of(numbers, [](double v) { return std::isfinite(v); });
  if (equal || !finite) return result;
  result.value = median(numbers);
  if (has_mean_interval(numbers.size())) {
    const Interval interval = mean_interval(numbers);
    result.low = interval.low;
    result.high = interval.high;
    return result;
  }
  result.low = result.high = {};
  if (!std::ranges::all_of(values, [](const Metric& m) { return m.low && m.high; })) return result;
  for (const Metric& metric : values) {
    result.low = std::min(result.low.value_or(*metric.low), *metric.low);
    result.high = std::max(result.high.value_or(*metric.high), *metric.high);
  }
  return result;
}

Cell cell_of(const FoundRow& found) {
  const Row& row = found.row;
  Cell cell;
  cell.experiment = row.experiment;
  cell.case_name = row.case_name;
  cell.variant = row.variant;
  cell.device = row.device;
  cell.host = provenance_text(row, "host");
  cell.axes = row.axes;
  cell.overrides = row.overrides;
  cell.identity = row.identity;
  cell.image = picture_of(found);
  cell.renderer = provenance_text(row, "opengl_renderer");
  cell.title = provenance_text(row, "title");
  if (const auto view = row.provenance.find("view"); view != row.provenance.end()) cell.view = *view;
  return cell;
}

/// Returns the members that name a cell. Cells with equal names but different identities measured different
/// inputs.
auto names(const Cell& c) {
  return std::tie(c.experiment, c.case_name, c.variant, c.device, c.host, c.overrides);
}

/// Adds `times`, which one process measured and recorded in `row`.
void add_times(Cell& cell, const Row& row, std::vector<double> times) {
  if (times.empty()) return;
  cell.timings.processes.push_back(std::move(times));
  if (const auto started = provenance_number(row, "started_s")) cell.timings.started_s.push_back(*started);
}

void add(Cell& cell, const Row& row) {
  if (row.status != Status::ok && cell.status == Status::ok) {
    cell.status = row.status;
    cell.reason = row.reason;
  }
  cell.contended = cell.contended || !load_warning(row).empty();
  cell.interrupted = cell.interrupted || !interruption_warning(row).empty();
  if (const std::string hash = provenance_text(row, "picture_hash"); !hash.empty())
    cell.picture_hashes.insert(hash);
  if (!row.image_hash.empty()) cell.pixel_hashes.insert(row.image_hash);
  std::vector<double> times = frame_ms(row);
  if (times.empty()) return;
  cell.converged = cell.converged && is_precise(row);
  if (const Drift drift = drift_of(times); drifts(drift) && std::abs(drift.change) > std::abs(cell.drift))
    cell.drift = drift.change;
  add_times(cell, row, std::move(times));
}

/// Samples and metrics of all rows that one cell combines.
struct Samples {
  std::map<std::string, std::vector<double>> times;  // phase -> times_of() of all rows, in ms
  std::vector<double> cpu;
  std::map<std::string, std::vector<Metric>> metrics;
  void add(const Row& row) {
    for (const auto& [name, metric] : row.metrics) metrics[name].push_back(metric);
    for (const auto& [phase, samples] : row.samples) {
      const std::vector<double>& own = times_of(row, phase);
      times[phase].insert(times[phase].end(), own.begin(), own.end());
      if (phase == "frame") cpu.insert(cpu.end(), samples.cpu_ms.begin(), samples.cpu_ms.end());
    }
  }
};

void summarize_times(Cell& cell) {
  std::vector<double> pooled;
  for (const auto& process : cell.timings.processes)
    pooled.insert(pooled.end(), process.begin(), process.end());
  if (pooled.empty()) return;
  cell.median_ms = median(pooled);
  cell.interval_ms = nested_median_interval(cell.timings.processes, 1);
}

void summarize(Cell& cell, const std::vector<FoundRow>& rows) {
  Samples samples;
  for (const std::size_t r : cell.rows) samples.add(rows[r].row);
  for (const auto& [name, values] : samples.metrics) {
    cell.metrics[name] = combined_metric(values);
    for (const Metric& metric : values) cell.runs[name].push_back(metric.value);
  }
  if (cell.status != Status::ok) return;
  for (const auto& [phase, times] : samples.times)
    if (phase != "frame" && !times.empty()) cell.phase_ms[phase] = median(times);
  if (!samples.cpu.empty()) cell.cpu_ms = median(samples.cpu);
  summarize_times(cell);
}

}  // namespace

std::string sample_of(const std::vector<Cell>& cells) {
  const bool equal =
      std::ranges::all_of(cells, [&](const Cell& c) { return c.sample == cells.front().sample; });
  return cells.empty() || !equal ? "sample" : cells.front().sample;
}

bool has_interval(const Cell& cell) {
  constexpr std::size_t fewest = 6;  // of samples, for an interval of 95% from order statistics
  std::size_t samples = 0;
  for (const auto& process : cell.timings.processes) samples += process.size();
  return samples >= fewest;
}

std::string Cell::axis(const std::string& key) const {
  return value_at(axes, key);
}

bool is_usual_reading(std::string_view value) {
  return value.empty() || value == "paper" || value == "default";
}

std::string Cell::reading() const {
  const std::string value = axis("reading");
  return is_usual_reading(value) ? "" : value;
}

const Metric* Cell::metric(const std::string& name) const {
  const auto found = metrics.find(name);
  return found == metrics.end() ? nullptr : &found->second;
}

const Cell* counterpart(const std::vector<Cell>& cells, const Cell& like, const std::string& axis,
                        const std::string& value) {
  std::map<std::string, std::string> axes = like.axes;
  axes[axis] = value;
  const auto found = std::ranges::find_if(cells, [&](const Cell& c) {
    return timed(c) && c.axes == axes && c.variant == like.variant && c.device == like.device &&
           c.host == like.host;
  });
  return found == cells.end() ? nullptr : &*found;
}

std::string changes_of(const std::map<std::string, std::string>& overrides, std::string_view separator) {
  std::string text;
  for (const auto& [key, value] : overrides)
    text += fmt::format("{}{}={}", text.empty() ? "" : separator, key, value);
  return text;
}

std::vector<Cell> cells_of(const std::vector<FoundRow>& rows) {
  std::vector<Cell> cells;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const FoundRow& found = rows[r];
    Cell cell = cell_of(found);
    auto place = std::ranges::find_if(
        cells, [&](const Cell& c) { return names(c) == names(cell) && c.identity == cell.identity; });
    if (place == cells.end()) place = cells.insert(place, std::move(cell));
    place->rows.push_back(r);
    add(*place, found.row);
  }
  std::map<std::string, Experiment>
      shipped;  // for rows of earlier versions, which do not name their pipeline
  for (Cell& cell : cells) {
    summarize(cell, rows);
    std::string pipeline = provenance_text(rows[cell.rows.front()].row, "pipeline");
    if (pipeline.empty()) {
      const auto [place, added] = shipped.try_emplace(cell.experiment);
      if (added) place->second = shipped_experiment(cell.experiment).value_or(Experiment{});
      if (const auto variant = place->second.variants.find(cell.variant);
          variant != place->second.variants.end())
        pipeline = value_at(variant->second, std::string(pipeline_key));
    }
    cell.sample = sample_of(pipeline);
  }
  std::ranges::stable_sort(cells, {}, [](const Cell& c) { return std::tie(c.experiment, c.device, c.host); });
  for (int index = 0; Cell & cell : cells) cell.index = index++;
  return cells;
}

void use_phase(std::vector<Cell>& cells, const std::vector<FoundRow>& rows, const std::string& phase) {
  std::set<std::string> known;
  for (Cell& cell : cells) {
    cell.timings = {};
    cell.median_ms = 0;
    cell.interval_ms = {};
    for (const std::size_t index : cell.rows) {
      const Row& row = rows[index].row;
      for (const auto& [name, samples] : row.samples) known.insert(name);
      if (row.status == Status::ok) add_times(cell, row, times_of(row, phase));
    }
    if (cell.status == Status::ok) summarize_times(cell);
  }
  if (std::ranges::none_of(cells, timed))
    throw InputError(
        fmt::format("no row has times of the phase '{}'; the phases are {}", phase, fmt::join(known, ", ")));
}

std::optional<Ratio> ratio_of(const Cell& cell) {
  const Metric* paper = cell.metric("paper_fps");
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
