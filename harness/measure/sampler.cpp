#include "harness/measure/sampler.hpp"

#include <chrono>

#include "harness/measure/statistics.hpp"

namespace pelage {

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

}  // namespace pelage
