#include "harness/claims/cells.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>

#include "harness/base/median.hpp"
#include "harness/hash.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/measure/interruptions.hpp"

namespace pelage::claims {
namespace {

/// Returns the row's axes, with "variant".
std::map<std::string, std::string> axes_of(const Row& row) {
  std::map<std::string, std::string> axes = row.axes;
  axes.try_emplace("variant", row.variant);
  return axes;
}

bool selects(const Selection& selection, const std::map<std::string, std::string>& axes) {
  return std::ranges::all_of(selection,
                             [&](const auto& one) { return value_at(axes, one.first) == one.second; });
}

bool covers(const Claim& claim, const Row& row) {
  const auto axes = axes_of(row);
  // A ratio uses no other case than its two. With phases, one row has the times of both.
  if (!claim.of.empty() && claim.phases.empty() && !selects(claim.of, axes) && !selects(claim.to, axes))
    return false;
  return (row.overrides.empty() || claim.overridden) &&
         std::all_of(claim.where.begin(), claim.where.end(), [&axes](const auto& condition) {
           const auto& [axis, values] = condition;
           return std::find(values.begin(), values.end(), value_at(axes, axis)) != values.end();
         });
}

/// Returns the phases from whose times the quantity follows: the first alone, or for phase_share and
/// ratio_by_phase the frame and the phase within it; "" for none. The times of `frame` count as frame times.
std::array<std::string, 2> phases_of(const Claim& claim, const std::string& frame) {
  if (claim.quantity == Quantity::metric) return {};
  if (claim.quantity == Quantity::phase_share || claim.effect == Effect::ratio_by_phase)
    return {frame, claim.phase};
  return {claim.quantity == Quantity::phase_time ? claim.phase : frame, ""};
}

/// Returns why the claim's quantity cannot be computed from the row, or "" if it can.
std::string missing(const Claim& claim, const Row& row, const std::string& frame) {
  if (row.status != Status::ok)
    return fmt::format("{}{}{}", to_text(row.status), row.reason.empty() ? "" : ": ", row.reason);
  for (const std::string& name : {claim.metric, claim.per})
    if (!name.empty() && !row.metrics.contains(name)) return fmt::format("the row has no metric {}", name);
  for (const std::string& name : phases_of(claim, frame))
    if (!name.empty() && times_of(row, name).empty())
      return fmt::format("the row has no times of the phase {}", name);
  return {};
}

/// Returns the cells to which the row belongs: one cell, or one cell per phase if the claim has `phases`.
/// They do not contain the row yet.
std::vector<Cell> empty_cells(const Claim& claim, const Row& row) {
  Cell cell{row.case_name, axes_of(row), "frame", {}};
  cell.axes.try_emplace("experiment", row.experiment);
  for (const auto& [key, value] : row.overrides) cell.axes.try_emplace(key, value);
  if (claim.phases.empty()) return {cell};
  std::vector<Cell> cells;
  for (const auto& [phase, value] : claim.phases) {
    cells.push_back(cell);
    cells.back().phase = phase;
    cells.back().axes[claim.axis] = value;
    cells.back().name = fmt::format("{} {}", row.case_name, phase);
  }
  return cells;
}

std::uint64_t seed_of(const Cell& cell) {
  const Row& row = *cell.processes.front();
  return Hash().text(row.experiment).text(row.case_name).text(row.variant).value();
}

}  // namespace

Cells cells_of(const Claim& claim, const std::vector<const Row*>& rows) {
  Cells result;
  std::map<std::tuple<std::map<std::string, std::string>, std::string>, std::size_t> known;
  for (const Row* row : rows) {
    if (!covers(claim, *row)) continue;
    const bool contended = !load_warning(*row).empty() || !interruption_warning(*row).empty();
    result.contended += contended;
    for (Cell& cell : empty_cells(claim, *row)) {
      const auto [place, added] = known.try_emplace({cell.axes, cell.name}, result.cells.size());
      if (added) result.cells.push_back(std::move(cell));
      // A cell is left out, without processes, if a row is unusable, as in the tables of pelage report.
      Cell& own = result.cells[place->second];
      if (!added && own.processes.empty()) continue;
      own.processes.push_back(row);
      own.contended += contended;
      if (const std::string why = missing(claim, *row, own.phase); !why.empty()) {
        result.left_out.push_back(fmt::format("{} ({})", own.name, why));
        own.processes.clear();
      }
    }
  }
  std::erase_if(result.cells, [](const Cell& cell) { return cell.processes.empty(); });
  return result;
}

std::vector<std::string> unknown_values(const Claim& claim, const std::vector<const Row*>& rows) {
  std::map<std::string, std::set<std::string>> wanted, found;
  for (const auto& [axis, values] : claim.where) wanted[axis].insert(values.begin(), values.end());
  if (claim.phases.empty())
    for (const Selection* selection : {&claim.of, &claim.to})
      for (const auto& [axis, value] : *selection) wanted[axis].insert(value);
  for (const Row* row : rows) {
    for (const auto& [axis, value] : axes_of(*row)) found[axis].insert(value);
    found["experiment"].insert(row->experiment);
  }
  std::vector<std::string> texts;
  for (const auto& [axis, values] : wanted) {
    if (!found.contains(axis)) {
      texts.push_back(fmt::format("no row has the axis {}", axis));
      continue;
    }
    for (const std::string& value : values)
      if (!found[axis].contains(value))
        texts.push_back(
            fmt::format("no row has {} = {} (the rows have {})", axis, value, fmt::join(found[axis], ", ")));
  }
  return texts;
}

Drawing::Drawing(const Claim& claim, const Cell& cell, double spread, int separate_processes)
    : claim_(claim), random_(seed_of(cell)) {
  static const std::set<std::string> measured_units{"ms", "1/s", "times", "fps"};
  for (const Row* row : cell.processes) {
    Process process;
    if (claim.quantity == Quantity::metric) {
      const Metric& metric = row->metrics.at(claim.metric);
      process.metric = metric.value;
      // The limits `low` and `high` of a metric form a 95% interval. Such an interval of a normal
      // distribution is 3.92 standard deviations wide.
      if (metric.low && metric.high && metric.relation.empty())
        process.metric_deviation = (*metric.high - *metric.low) / 3.92;
      measured_metric_ = measured_units.contains(metric.unit);
    } else {
      const auto [time, part] = phases_of(claim, cell.phase);
      process.times = times_of(*row, time);
      process.phase_times = times_of(*row, part);
    }
    if (!claim.per.empty()) process.per = row->metrics.at(claim.per).value;
    processes_.push_back(std::move(process));
  }
  if (int(processes_.size()) < separate_processes) spread_ = spread;
}

Value Drawing::value_of_pools() {
  if (claim_.quantity == Quantity::metric) return {median_reordering(metrics_), 0};
  const double time = median_reordering(times_);
  if (claim_.effect == Effect::ratio_by_phase) return {median_reordering(phase_times_), time};
  const double quantity = claim_.quantity == Quantity::phase_share  ? median_reordering(phase_times_) / time
                          : claim_.quantity == Quantity::frame_rate ? 1000 / time
                                                                    : time;
  return {quantity / processes_.front().per, 0};
}

Value Drawing::measured() {
  for (auto* pool : {&times_, &phase_times_, &metrics_}) pool->clear();
  for (const Process& process : processes_) {
    times_.insert(times_.end(), process.times.begin(), process.times.end());
    phase_times_.insert(phase_times_.end(), process.phase_times.begin(), process.phase_times.end());
    metrics_.push_back(process.metric / process.per);
  }
  return value_of_pools();
}

Value Drawing::drawn() {
  for (auto* pool : {&times_, &phase_times_, &metrics_}) pool->clear();
  for (std::size_t i = 0; i < processes_.size(); ++i) {
    const Process& process = processes_[random_() % processes_.size()];
    const double by = spread_ > 0 ? std::exp(spread_ * normal_(random_)) : 1;
    if (claim_.quantity == Quantity::metric) {
      const double noise = process.metric_deviation > 0 ? process.metric_deviation * normal_(random_) : 0.0;
      metrics_.push_back((process.metric + noise) * (measured_metric_ ? by : 1) / process.per);
    }
    // If the phase has one sample per frame, the bootstrap draw takes the phase time and the frame time of
    // the same frame.
    const bool together = process.phase_times.size() == process.times.size();
    for (std::size_t s = 0; s < process.times.size(); ++s) {
      const std::size_t sample = random_() % process.times.size();
      times_.push_back(process.times[sample] * by);
      if (together) phase_times_.push_back(process.phase_times[sample] * by);
    }
    if (!together)
      std::generate_n(std::back_inserter(phase_times_), process.phase_times.size(),
                      [&] { return process.phase_times[random_() % process.phase_times.size()] * by; });
  }
  return value_of_pools();
}

bool PaperDrawing::possible(const Claim& claim, const Cell& cell) {
  if (!claim.phases.empty() || !claim.per.empty()) return false;
  if (claim.quantity != Quantity::frame_rate && claim.quantity != Quantity::frame_time) return false;
  const auto& metrics = cell.processes.front()->metrics;
  const auto found = metrics.find("paper_fps");
  // A published rate such as "< 1" is only an upper bound. Only the effect share_of_cases accepts such a
  // bound.
  return found != metrics.end() && found->second.value > 0 &&
         (found->second.relation != "<" || claim.effect == Effect::share_of_cases);
}

PaperDrawing::PaperDrawing(const Claim& claim, const Cell& cell) : claim_(claim), random_(seed_of(cell)) {
  const Metric& paper = cell.processes.front()->metrics.at("paper_fps");
  const bool bound = paper.relation == "<";
  rate_ = bound ? paper.value / 2 : paper.value;
  low_ = bound ? 0 : paper.low.value_or(rate_);
  high_ = paper.high.value_or(rate_);
}

Value PaperDrawing::value_of(double rate) const {
  return {claim_.quantity == Quantity::frame_rate ? rate : 1000 / rate, 0};
}

Value PaperDrawing::measured() const {
  return value_of(rate_);
}

Value PaperDrawing::drawn() {
  // The upper 53 bits of a random number give a number from 0 to less than 1.
  return value_of(low_ + (high_ - low_) * double(random_() >> 11) * 0x1p-53);
}

}  // namespace pelage::claims
