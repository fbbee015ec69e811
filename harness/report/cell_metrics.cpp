#include "harness/report/cell_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "harness/measure/statistics.hpp"

namespace pelage {

Metric combined_metric(std::span<const Metric> values) {
  Metric result = values.front();
  std::vector<double> numbers;
  numbers.reserve(values.size());
  for (const Metric& metric : values) numbers.push_back(metric.value);
  const bool equal = std::all_of(numbers.begin(), numbers.end(), [&](double v) { return v == numbers[0]; });
  const bool finite = std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
  if (equal || !finite) return result;
  result.value = median(numbers);
  if (has_mean_interval(numbers.size())) {
    const Interval interval = mean_interval(numbers);
    result.low = interval.low;
    result.high = interval.high;
    return result;
  }
  result.low = result.high = {};
  const auto limited = [](const Metric& metric) { return metric.low && metric.high; };
  if (!std::all_of(values.begin(), values.end(), limited)) return result;
  for (const Metric& metric : values) {
    result.low = std::min(result.low.value_or(*metric.low), *metric.low);
    result.high = std::max(result.high.value_or(*metric.high), *metric.high);
  }
  return result;
}

}  // namespace pelage
