#include "harness/claims/drawing.hpp"

#include <cmath>
#include <set>

#include "harness/base/median.hpp"
#include "harness/hash.hpp"

namespace pelage::claims {
namespace {

std::uint64_t seed_of(const Cell& cell) {
  Hash hash;
  const Row& row = *cell.processes.front();
  hash.text(row.experiment).text(row.case_name).text(row.variant);
  return hash.value();
}

}  // namespace

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
      process.times =
          times_of(*row, claim.quantity == Quantity::phase_time && claim.effect != Effect::ratio_by_phase
                             ? claim.phase
                             : cell.phase);
      if (!claim.phase.empty() &&
          (claim.quantity == Quantity::phase_share || claim.effect == Effect::ratio_by_phase))
        process.phase_times = times_of(*row, claim.phase);
    }
    if (!claim.per.empty()) process.per = row->metrics.at(claim.per).value;
    processes_.push_back(std::move(process));
  }
  if (int(processes_.size()) < separate_processes) spread_ = spread;
}

double Drawing::factor() {
  return spread_ > 0 ? std::exp(spread_ * normal_(random_)) : 1;
}

Value Drawing::value_of_pools() {
  if (claim_.quantity == Quantity::metric) return {median_reordering(metrics_), 0};
  const double time = median_reordering(times_), per = processes_.front().per;
  if (claim_.effect == Effect::ratio_by_phase) return {median_reordering(phase_times_), time};
  if (claim_.quantity == Quantity::phase_share) return {median_reordering(phase_times_) / time / per, 0};
  return {(claim_.quantity == Quantity::frame_rate ? 1000 / time : time) / per, 0};
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
    const double by = factor();
    if (claim_.quantity == Quantity::metric) {
      const double noise = process.metric_deviation > 0 ? process.metric_deviation * normal_(random_) : 0.0;
      metrics_.push_back((process.metric + noise) * (measured_metric_ ? by : 1) / process.per);
      continue;
    }
    // If the phase has one sample per frame, the bootstrap draw takes the phase time and the frame time of
    // the same frame.
    const bool together = process.phase_times.size() == process.times.size();
    for (std::size_t s = 0; s < process.times.size(); ++s) {
      const std::size_t sample = random_() % process.times.size();
      times_.push_back(process.times[sample] * by);
      if (together) phase_times_.push_back(process.phase_times[sample] * by);
    }
    for (std::size_t s = 0; !together && s < process.phase_times.size(); ++s)
      phase_times_.push_back(process.phase_times[random_() % process.phase_times.size()] * by);
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
