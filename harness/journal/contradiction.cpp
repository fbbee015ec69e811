// Refuses rows whose fields contradict each other. A row is the recorded result of a case.
#include "harness/journal/contradiction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "harness/compare/tolerances.hpp"
#include "harness/hash.hpp"
#include "harness/journal/field.hpp"
#include "harness/journal/part_hashes.hpp"

namespace pelage {
namespace {

using Times = std::vector<double>;

/// Largest permitted ratio of event time to wall time. It is above 1, because the clocks of device and host
/// drift.
constexpr double most_event_share = 1.1;

/// The largest permitted CPU time is most_cpu_share * (number of CPUs) * (wall time) + cpu_margin_ms. CPU
/// time is measured over a slightly longer interval than wall time.
constexpr double most_cpu_share = 1.5, cpu_margin_ms = 20;

/// The smallest number of samples for which a 95% interval of the median exists (see median_interval()).
constexpr std::size_t fewest_converged = 6;

/// Largest permitted relative difference between a recorded metric and the value computed from the row's
/// times.
constexpr double rounding = 1e-6;

double median_of(Times times) {
  std::sort(times.begin(), times.end());
  const std::size_t middle = times.size() / 2;
  return times.size() % 2 ? times[middle] : (times[middle - 1] + times[middle]) / 2;
}

bool equal(double a, double b) {
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

/// The weakest limit that any version of pelage has used for a check of a picture. If `at_least` is true, the
/// checked value must be at least the limit, otherwise at most the limit.
struct WeakestLimit {
  const char* metric;
  double limit;
  bool at_least;
};
constexpr std::array<WeakestLimit, 3> kWeakest{{{"psnr", tolerance::other_filter_psnr, true},
                                                {"p99.9", tolerance::flip, false},
                                                {"flips", tolerance::flip_share, false}}};

/// Throws InputError if the limit of a picture's check is weaker than the limit in kWeakest, or if the check
/// compares in the other direction ("at most" instead of "at least").
void refuse_weakened(const Check& check) {
  for (const WeakestLimit& weakest : kWeakest) {
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

/// Throws InputError if the event times of a frame's phases do not add up to the frame's event time, or if
/// the frames' median event time exceeds most_event_share times their median wall time.
void refuse_events(const Row& row, const PhaseSamples& frame) {
  Times sums(frame.event_ms.size(), 0);
  for (const auto& [phase, times] : row.samples) {
    if (phase == "frame" || times.event_ms.empty()) continue;
    if (frame.event_ms.empty())
      throw InputError(fmt::format("the row has event times of the phase {}, but none of the frames", phase));
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += times.event_ms[i];
  }
  if (frame.event_ms.empty()) return;
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (!equal(sums[i], frame.event_ms[i]))
      throw InputError(fmt::format(
          "the event times of the phases of a frame sum to {} ms, but the frame's event time is {} ms",
          sums[i], frame.event_ms[i]));
  if (median_of(frame.event_ms) > most_event_share * median_of(frame.wall_ms))
    throw InputError(
        fmt::format("the median event time of a frame is {} ms, but its median wall time is {} ms",
                    median_of(frame.event_ms), median_of(frame.wall_ms)));
}

void refuse_cpu(const Row& row, const std::string& phase, const PhaseSamples& times) {
  const double cpus = number(row, "cpus").value_or(0);
  if (times.cpu_ms.empty() || times.wall_ms.empty() || cpus < 1) return;
  const double cpu = median_of(times.cpu_ms), wall = median_of(times.wall_ms);
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

/// Returns the median of the ratios a[i] / b[i].
double ratio_of(const Times& a, const Times& b) {
  Times ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return median_of(std::move(ratios));
}

/// Computes the metrics that depend on the row's times. Throws InputError if a recorded metric differs from
/// the computed metric.
void refuse_metrics(const Row& row) {
  const Times& frame = row.samples.at("frame").wall_ms;
  const auto refuse = [](const std::string& name, double recorded, double computed) {
    throw InputError(
        fmt::format("the metric {} is {}, but the row's times give {}", name, recorded, computed));
  };
  const auto rate = row.metrics.find("fragments_per_s"), covered = row.metrics.find("covered_fragments");
  if (rate != row.metrics.end() && covered != row.metrics.end()) {
    const double computed = covered->second.value / (median_of(frame) / 1000);
    if (!equal(rate->second.value, computed)) refuse("fragments_per_s", rate->second.value, computed);
  }
  // For the phases "half" and "quarter", which draw fewer layers, and "baseline", which draws another scene,
  // the metric PHASE_ratio is frame time / phase time. For the phases of other pipelines, the metric is phase
  // time / frame time.
  for (const auto& [phase, times] : row.samples) {
    const auto ratio = row.metrics.find(phase + "_ratio");
    if (phase == "frame" || times.wall_ms.empty() || ratio == row.metrics.end()) continue;
    const bool cost = phase == "half" || phase == "quarter" || phase == "baseline";
    const double computed = cost ? ratio_of(frame, times.wall_ms) : ratio_of(times.wall_ms, frame);
    if (!equal(ratio->second.value, computed)) refuse(ratio->first, ratio->second.value, computed);
  }
}

bool is_hash(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Throws InputError if the hash of the part `part` in the row's identity differs from `hash`. The caller
/// computes `hash` from the field `field` of the row. If `hash` is empty, the row does not have this field.
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

/// Throws InputError if the hashes in the row's identity disagree with other fields of the row.
void refuse_parts(const Row& row) {
  refuse_part(row, "scene", text(row, "scene_hash"), "scene_hash");
  refuse_part(row, "mesh", text(row, "mesh_hash"), "mesh_hash");
  refuse_part(row, "device", device_hash(row.provenance), "the provenance");
  if (!row.tuning.empty()) refuse_part(row, "tuning", tuning_hash(row.tuning), "tuning");
}

void refuse_names(const Row& row) {
  if (const std::string recorded = text(row, "device_name"); !recorded.empty() && recorded != row.device)
    throw InputError(
        fmt::format("the row is of the device '{}', but its provenance says '{}'", row.device, recorded));
  const std::optional<double> seed = number(row, "check_seed");
  if (seed && row.schema > 1 && *seed != double(check_seed(row.case_name)))
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
