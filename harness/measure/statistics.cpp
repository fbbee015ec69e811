#include "harness/measure/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <random>

#include "harness/record/ratios.hpp"

namespace pelage {
namespace {

/// Let x_(0), ..., x_(n-1) be n values in ascending order. Returns the largest r for which the probability
/// that [x_(r), x_(n-1-r)] contains the median of the distribution is at least `confidence`. Returns -1 if
/// there is no such r.
std::ptrdiff_t interval_rank(std::size_t n, double confidence) {
  std::ptrdiff_t rank = -1;
  // The number X of values below the median m is binomially distributed.
  const boost::math::binomial_distribution<double> below(double(n), 0.5);
  // m is below x_(r) with the probability P(X <= r), and above x_(n-1-r) with the same probability.
  while (2 * boost::math::cdf(below, double(rank + 1)) <= 1 - confidence) ++rank;
  return rank;
}

}  // namespace

bool has_median_interval(std::size_t count, double confidence) {
  return interval_rank(count, confidence) >= 0;
}

Interval median_interval(std::span<const double> values, double confidence) {
  std::vector<double> v(values.begin(), values.end());
  std::ranges::sort(v);
  const auto rank = std::size_t(std::max<std::ptrdiff_t>(0, interval_rank(v.size(), confidence)));
  return {v[rank], v[v.size() - 1 - rank]};
}

Interval nested_median_interval(std::span<const std::vector<double>> processes, std::uint64_t seed,
                                double confidence, int resamples) {
  if (processes.size() == 1) return median_interval(processes.front(), confidence);
  std::mt19937_64 random(seed);
  auto below = [&random](std::size_t n) { return std::size_t(random() % n); };
  std::vector<double> medians;
  std::vector<double> pooled;
  for (int i = 0; i < resamples; ++i) {
    pooled.clear();
    for (std::size_t p = 0; p < processes.size(); ++p) {
      const std::vector<double>& chosen = processes[below(processes.size())];
      for (std::size_t s = 0; s < chosen.size(); ++s) pooled.push_back(chosen[below(chosen.size())]);
    }
    medians.push_back(median(pooled));
  }
  return {quantile(medians, (1 - confidence) / 2), quantile(medians, (1 + confidence) / 2)};
}

bool has_mean_interval(std::size_t count) {
  return count >= 3;
}

Interval mean_interval(std::span<const double> values, double confidence) {
  const bool positive = std::all_of(values.begin(), values.end(), [](double v) { return v > 0; });
  const auto count = double(values.size());
  double mean = 0, squares = 0;
  const auto scaled = [positive](double v) { return positive ? std::log(v) : v; };
  for (const double v : values) mean += scaled(v) / count;
  for (const double v : values) squares += std::pow(scaled(v) - mean, 2);
  const boost::math::students_t_distribution<double> t(count - 1);
  const double reach =
      boost::math::quantile(t, (1 + confidence) / 2) * std::sqrt(squares / (count - 1) / count);
  if (positive) return {std::exp(mean - reach), std::exp(mean + reach)};
  return {mean - reach, mean + reach};
}

Drift drift_of(std::span<const double> values) {
  constexpr std::size_t least = 8, most = 400;
  if (values.size() < least) return {};
  std::vector<double> chosen;
  const std::size_t count = std::min(values.size(), most);
  chosen.reserve(count);
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(values[i * values.size() / count]);
  std::vector<double> slopes;
  double rises = 0;  // Kendall's S: number of rising pairs minus number of falling pairs
  for (std::size_t j = 1; j < count; ++j)
    for (std::size_t i = 0; i < j; ++i) {
      slopes.push_back((chosen[j] - chosen[i]) / double(j - i));
      rises += double(chosen[j] > chosen[i]) - double(chosen[j] < chosen[i]);
    }
  std::map<double, double> times;  // value -> number of samples with this value
  for (const double v : chosen) ++times[v];
  if (times.size() == 1) return {};
  const auto term = [](double n) { return n * (n - 1) * (2 * n + 5); };
  double variance = term(double(count));
  for (const auto& [value, n] : times) variance -= term(n);
  // The continuity correction reduces the absolute value of Kendall's S (`rises`) by 1.
  const double z = std::max(0.0, std::abs(rises) - 1) / std::sqrt(variance / 18);
  return {median(slopes) * double(count - 1) / median(chosen),
          2 * boost::math::cdf(boost::math::normal(), -z)};
}

bool drifts(const Drift& drift) {
  return drift.p < 0.01 && std::abs(drift.change) > 0.02;
}

double relative_half_width(std::span<const double> values, double confidence) {
  const Interval interval = median_interval(values, confidence);
  return (interval.high - interval.low) / (2 * median(values));
}

Metric median_metric(std::span<const double> values, const std::string& unit) {
  const Interval interval = median_interval(values);
  return {median(values), unit, "", interval.low, interval.high};
}

Metric median_ratio(std::span<const double> a, std::span<const double> b) {
  return median_metric(ratios_by_round(a, b), "times");
}

bool is_precise(const Row& row) {
  const std::vector<double> times = frame_ms(row);
  const double asked = row.provenance.value("precision", 1.0);
  return has_median_interval(times.size()) && relative_half_width(times) <= (asked < 1 ? asked : 0.02);
}

}  // namespace pelage
