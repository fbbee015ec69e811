#include "harness/measure/sampler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "harness/measure/statistics.hpp"

namespace pelage {
namespace {

constexpr double most_share = 1.1, least_share = 1e-4;
constexpr std::size_t fewest_equal = 6;

bool all_equal(const std::vector<double>& times) {
  return std::all_of(times.begin(), times.end(), [&](double ms) { return ms == times.front(); });
}

}  // namespace

Sampling take_samples(const std::function<FrameSample()>& frame, const SamplingLimits& limits,
                      const std::function<double()>& seconds) {
  Sampling result;
  result.first_launch_ms = frame().wall_ms;

  const double warm_from = seconds();
  do frame();
  while (seconds() - warm_from < limits.warm_up_s);

  std::vector<double>& wall = result.samples["frame"].wall_ms;
  const double from = seconds();
  while (true) {
    const FrameSample sample = frame();
    wall.push_back(sample.wall_ms);
    double sum = 0;
    for (const auto& [phase, milliseconds] : sample.phase_event_ms) {
      result.samples[phase].event_ms.push_back(milliseconds);
      sum += milliseconds;
    }
    for (const auto& [phase, milliseconds] : sample.phase_wall_ms)
      result.samples[phase].wall_ms.push_back(milliseconds);
    if (sample.cpu_ms) result.samples["frame"].cpu_ms.push_back(*sample.cpu_ms);
    for (const auto& [phase, milliseconds] : sample.phase_cpu_ms)
      result.samples[phase].cpu_ms.push_back(milliseconds);
    if (!sample.phase_event_ms.empty()) result.samples["frame"].event_ms.push_back(sum);

    result.converged = has_median_interval(wall.size()) && relative_half_width(wall) <= limits.precision;
    const int count = int(wall.size());
    if (count >= limits.most || seconds() - from >= limits.limit_s) break;
    if (count >= limits.least && result.converged) break;
  }
  return result;
}

Sampling take_samples(const std::function<FrameSample()>& frame, const SamplingLimits& limits) {
  using Clock = std::chrono::steady_clock;
  return take_samples(frame, limits, [from = Clock::now()] {
    return std::chrono::duration<double>(Clock::now() - from).count();
  });
}

std::string implausible_events(const std::map<std::string, PhaseSamples>& samples) {
  const std::vector<double>&event = samples.at("frame").event_ms, &wall = samples.at("frame").wall_ms;
  if (event.empty()) return {};
  for (const auto& [phase, times] : samples)
    if (!times.event_ms.empty() && times.event_ms.size() != wall.size())
      return fmt::format("only {} of {} frames have event times of the phase {}", times.event_ms.size(),
                         wall.size(), phase);
  const double share = median(event) / median(wall);
  if (share > most_share || share < least_share)
    return fmt::format("the median event time is {:.3g} ms, the median wall time {:.3g} ms", median(event),
                       median(wall));
  if (event.size() >= fewest_equal && all_equal(event) && !all_equal(wall))
    return fmt::format("the event times of all {} frames are equal", event.size());
  return {};
}

void remove_implausible_events(Row& row) {
  const std::string reason = implausible_events(row.samples);
  if (reason.empty()) return;
  for (auto& [phase, times] : row.samples) times.event_ms.clear();
  std::erase_if(row.samples, [](const auto& phase) {
    return phase.second.wall_ms.empty() && phase.second.cpu_ms.empty();
  });
  row.provenance["event_times"] = "left out: " + reason;
}

}  // namespace pelage
