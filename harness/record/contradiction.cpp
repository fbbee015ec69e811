#include "harness/record/contradiction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "harness/base/median.hpp"
#include "harness/hash.hpp"
#include "harness/record/ratios.hpp"

namespace pelage {
namespace {

using Times = std::vector<double>;

/// Largest permitted ratio of event time to wall time. It is above 1, because the clocks of device and host
/// drift.
constexpr double most_event_share = 1.1;

/// The largest permitted CPU time is most_cpu_share * (number of CPUs) * (wall time) + cpu_margin_ms, because
/// it is measured over a slightly longer interval than wall time.
constexpr double most_cpu_share = 1.5, cpu_margin_ms = 20;

/// The smallest number of samples for which a 95% interval of the median exists (see median_interval()).
constexpr std::size_t fewest_converged = 6;

/// Largest permitted relative difference between a recorded and a computed metric.
constexpr double rounding = 1e-6;

bool equal(double a, double b) {
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

/// Refuses a limit weaker than in weakest_limits, and a check in the other direction ("at most" for "at
/// least").
void refuse_weakened(const Check& check) {
  for (const WeakestLimit& weakest : weakest_limits) {
    if (check.metric != weakest.metric || check.against == "experiment") continue;
    if (check.at_least != weakest.at_least ||
        (check.at_least ? check.limit < weakest.limit : check.limit > weakest.limit))
      throw InputError(fmt::format(
          "the row's check {} against {} has the limit {} {}, which is weaker than pelage's limit",
          check.metric, check.against, check.at_least ? ">=" : "<=", check.limit));
  }
}

void refuse_unchecked(const Row& row) {
  if (row.check.empty()) throw InputError("the row is ok, but nothing was checked");
  for (const Check& check : row.check) refuse_weakened(check);
  for (const Check& check : row.check)
    if (!check.holds())
      throw InputError(fmt::format("the row is ok, but its check {} against {} does not hold", check.metric,
                                   check.against));
}

void refuse_list(const std::string& name, const Times& times, std::size_t frames, bool zero_allowed) {
  if (!times.empty() && times.size() != frames)
    throw InputError(fmt::format("the row has {} {}, but {} timed frames", times.size(), name, frames));
  for (const double ms : times)
    if (!std::isfinite(ms) || ms < 0 || (ms == 0 && !zero_allowed))
      throw InputError(fmt::format("one of the {} is {} ms", name, ms));
}

void refuse_events(const Row& row, const PhaseSamples& frame) {
  Times sums(frame.event_ms.size(), 0);
  for (const auto& [phase, times] : row.samples) {
    if (phase == "frame" || times.event_ms.empty()) continue;
    if (frame.event_ms.empty())
      throw InputError(fmt::format("the row has event times of the phase {}, but none of the frames", phase));
    std::ranges::transform(sums, times.event_ms, sums.begin(), std::plus());
  }
  if (frame.event_ms.empty()) return;
  const auto [sum, event] = std::ranges::mismatch(sums, frame.event_ms, equal);
  if (sum != sums.end())
    throw InputError(fmt::format(
        "the event times of the phases of a frame sum to {} ms, but the frame's event time is {} ms", *sum,
        *event));
  if (median(frame.event_ms) > most_event_share * median(frame.wall_ms))
    throw InputError(
        fmt::format("the median event time of a frame is {} ms, but its median wall time is {} ms",
                    median(frame.event_ms), median(frame.wall_ms)));
}

void refuse_cpu(const Row& row, const std::string& phase, const PhaseSamples& times) {
  const double cpus = provenance_number(row, "cpus").value_or(0);
  if (times.cpu_ms.empty() || times.wall_ms.empty() || cpus < 1) return;
  const double cpu = median(times.cpu_ms), wall = median(times.wall_ms);
  if (cpu > most_cpu_share * cpus * wall + cpu_margin_ms)
    throw InputError(fmt::format(
        "the median CPU time of the phase {} is {} ms, which is more than {} CPUs can use in {} ms", phase,
        cpu, cpus, wall));
}

void refuse_times(const Row& row) {
  const auto frame = row.samples.find("frame");
  if (frame == row.samples.end() || frame->second.wall_ms.empty())
    throw InputError("the row is ok, but it has no times of frames");
  const std::size_t frames = frame->second.wall_ms.size();
  for (const auto& [phase, times] : row.samples) {
    refuse_list(fmt::format("wall times of the phase {}", phase), times.wall_ms, frames, false);
    refuse_list(fmt::format("event times of the phase {}", phase), times.event_ms, frames, false);
    refuse_list(fmt::format("CPU times of the phase {}", phase), times.cpu_ms, frames, true);
    refuse_cpu(row, phase, times);
  }
  refuse_events(row, frame->second);
  if (const auto claim = row.provenance.find("converged");
      claim != row.provenance.end() && claim->is_boolean() && claim->get<bool>() && frames < fewest_converged)
    throw InputError(
        fmt::format("the row says that its median converged, but it has only {} timed frames", frames));
}

void refuse_metrics(const Row& row) {
  const Times& frame = row.samples.at("frame").wall_ms;
  const auto demand = [&](const std::string& name, double computed) {
    const auto metric = row.metrics.find(name);
    if (metric != row.metrics.end() && !equal(metric->second.value, computed))
      throw InputError(fmt::format("the metric {} is {}, but the row's times give {}", name,
                                   metric->second.value, computed));
  };
  if (const auto covered = row.metrics.find("covered_fragments"); covered != row.metrics.end())
    demand("fragments_per_s", covered->second.value / (median(frame) / 1000));
  for (const auto& [phase, times] : row.samples) {
    if (phase == "frame" || times.wall_ms.empty()) continue;
    demand(ratio_metric(phase), median(ratios_by_round(times.wall_ms, frame)));
    demand(frame_over_metric(phase), median(ratios_by_round(frame, times.wall_ms)));
  }
}

bool is_hash(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Refuses a hash in the identity that differs from `hash`, which follows from the field `field` of the row
/// and is empty if the row does not have this field.
void refuse_part(const Row& row, const std::string& part, const std::string& hash, const char* field) {
  const auto found = row.identity.find(part);
  if (found == row.identity.end() || hash.empty() || found->second == hash) return;
  throw InputError(fmt::format("the part {} of the identity has the hash {}, but {} of the row gives {}",
                               part, found->second, field, hash));
}

void refuse_identity(const Row& row) {
  for (const auto& [part, hash] : row.identity)
    if (!is_hash(hash))
      throw InputError(fmt::format("the identity's part {} is '{}', not a hash", part, hash));
  if (!row.image_hash.empty() && !is_hash(row.image_hash))
    throw InputError(fmt::format("image_hash is '{}', not a hash", row.image_hash));
}

void refuse_parts(const Row& row) {
  refuse_part(row, "scene", provenance_text(row, "scene_hash"), "scene_hash");
  refuse_part(row, "mesh", provenance_text(row, "mesh_hash"), "mesh_hash");
  refuse_part(row, "device", device_hash(row.provenance), "the provenance");
  if (!row.tuning.empty()) refuse_part(row, "tuning", tuning_hash(row.tuning), "tuning");
}

void refuse_names(const Row& row) {
  if (const std::string recorded = provenance_text(row, "device_name");
      !recorded.empty() && recorded != row.device)
    throw InputError(
        fmt::format("the row is of the device '{}', but its provenance says '{}'", row.device, recorded));
  const std::optional<double> seed = provenance_number(row, "check_seed");
  if (seed && row.schema != 1 && *seed != double(check_seed(row.case_name)))
    throw InputError(
        fmt::format("the seed of the row's check is not the seed of a case with the name {}", row.case_name));
}

}  // namespace

void refuse_contradiction(const Row& row) {
  refuse_identity(row);
  refuse_names(row);
  if (row.status != Status::ok) {
    if (!row.samples.empty())
      throw InputError(fmt::format("the row has the status {}, but it has times", to_text(row.status)));
    return;
  }
  refuse_parts(row);
  refuse_unchecked(row);
  refuse_times(row);
  refuse_metrics(row);
}

}  // namespace pelage
