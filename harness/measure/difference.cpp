#include "harness/measure/difference.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace pelage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Lower limit of the standard error. If a coarse clock returns the same time for all samples, the computed
// standard error is 0, which does not prove that the times are equal.
constexpr double kLeastError = 1e-9;

/// Quantile of Student's t-distribution, which is normal for infinitely many degrees of freedom.
double t_quantile(double probability, double degrees) {
  if (std::isinf(degrees)) return boost::math::quantile(boost::math::normal(), probability);
  return boost::math::quantile(boost::math::students_t(degrees), probability);
}

double two_sided(double t, double degrees) {
  return 2 * boost::math::cdf(boost::math::students_t(degrees), -t);
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double variance_of_mean(const std::vector<double>& values) {
  const double middle = mean(values);
  double sum = 0;
  for (const double value : values) sum += std::pow(value - middle, 2);
  return sum / double(values.size() - 1) / double(values.size());
}

std::vector<double> log_medians(const Timings& timings) {
  std::vector<double> result;
  result.reserve(timings.processes.size());
  for (const auto& process : timings.processes) result.push_back(std::log(median(process)));
  return result;
}

/// Of one set of timings: the mean of the logarithms of the processes' medians, its variance, and the degrees
/// of freedom of the variance.
struct Mean {
  double value, variance, degrees;
};

Mean mean_of(const Timings& timings) {
  const std::vector<double> medians = log_medians(timings);
  const auto count = double(medians.size());
  if (medians.size() >= fewest_processes) return {mean(medians), variance_of_mean(medians), count - 1};
  double variance = 0;
  for (const auto& process : timings.processes) {
    // A 95% interval is 2 * 1.96 = 3.92 standard deviations wide.
    const double within = 2 * relative_half_width(process) / 3.92;
    variance += assumed_spread * assumed_spread + within * within;
  }
  return {mean(medians), variance / (count * count), kInfinity};
}

/// Returns the logarithm of b's median minus that of a's for each pair of consecutive processes; nothing if
/// the processes did not take turns (difference_of()).
std::vector<double> pairs_of(const Timings& a, const Timings& b) {
  const std::size_t count = a.processes.size();
  if (count < fewest_processes || b.processes.size() != count || a.started_s.size() != count ||
      b.started_s.size() != count)
    return {};
  struct Process {
    double started_s, log_median;
    bool in_b;
  };
  const std::vector<double> in_a = log_medians(a), in_b = log_medians(b);
  std::vector<Process> all;
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back({a.started_s[i], in_a[i], false});
    all.push_back({b.started_s[i], in_b[i], true});
  }
  std::ranges::stable_sort(all, {}, &Process::started_s);
  std::vector<double> result;
  for (std::size_t i = 0; i < all.size(); i += 2) {
    if (all[i].in_b == all[i + 1].in_b) return {};
    const double difference = all[i + 1].log_median - all[i].log_median;
    result.push_back(all[i + 1].in_b ? difference : -difference);
  }
  return result;
}

struct DifferenceLimits {
  double low, high;  // of ln(b / a)
};

DifferenceLimits limits_of(double threshold) {
  return {std::log1p(-std::min(threshold, 1.0)), std::log1p(threshold)};
}

/// Returns the distance from the limit, in standard errors, at which decide() decides about one of `count`
/// differences with the probability `power` in the strictest step of Holm's method.
double errors_of(double degrees, std::size_t count, double alpha, double power) {
  return t_quantile(1 - alpha / double(count) / 2, degrees) + t_quantile(power, degrees);
}

/// Returns the side of the limits on which the estimate is, and its distance from the nearest limit.
std::pair<Side, double> place_of(const Difference& difference, const DifferenceLimits& limits) {
  const double above = difference.log_ratio - limits.high, below = limits.low - difference.log_ratio;
  if (above > 0) return {Side::above, above};
  if (below > 0) return {Side::below, below};
  return {Side::within, std::min(-above, -below)};
}

}  // namespace

double typical_ms(const Timings& timings) {
  return std::exp(mean(log_medians(timings)));
}

Difference difference_of(const Timings& a, const Timings& b) {
  if (const std::vector<double> pairs = pairs_of(a, b); !pairs.empty())
    return {mean(pairs), std::max(kLeastError, std::sqrt(variance_of_mean(pairs))), double(pairs.size() - 1),
            true, false};
  const Mean of_a = mean_of(a), of_b = mean_of(b);
  const double variance = of_a.variance + of_b.variance;
  // The degrees of freedom follow from the formula of Welch and Satterthwaite. An assumed variance has
  // infinitely many degrees of freedom, so its term in `uncertainty` is 0.
  const double uncertainty =
      of_a.variance * of_a.variance / of_a.degrees + of_b.variance * of_b.variance / of_b.degrees;
  return {of_b.value - of_a.value, std::max(kLeastError, std::sqrt(variance)),
          uncertainty > 0 ? variance * variance / uncertainty : kInfinity, false,
          std::isinf(of_a.degrees) || std::isinf(of_b.degrees)};
}

Interval ratio_interval(const Difference& difference, double confidence) {
  const double reach = t_quantile((1 + confidence) / 2, difference.degrees) * difference.error;
  return {std::exp(difference.log_ratio - reach), std::exp(difference.log_ratio + reach)};
}

std::vector<Decision> decide(std::span<const Difference> differences, double threshold, double alpha) {
  const DifferenceLimits limits = limits_of(threshold);
  std::vector<Decision> decisions;
  decisions.reserve(differences.size());
  for (const Difference& d : differences) {
    const auto [side, distance] = place_of(d, limits);
    decisions.push_back({side, two_sided(distance / d.error, d.degrees), {}, {}});
  }
  std::vector<std::size_t> order(decisions.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return decisions[i].p; });
  bool stopped = false;
  for (std::size_t k = 0; k < order.size(); ++k) {
    Decision& decision = decisions[order[k]];
    const double share = alpha / double(order.size() - k);
    decision.confidence = 1 - share;
    decision.ratio = ratio_interval(differences[order[k]], decision.confidence);
    stopped = stopped || decision.p > share;
    if (stopped) decision.side = Side::undecided;
  }
  return decisions;
}

double detectable_change(const Difference& difference, std::size_t count, double threshold, double alpha,
                         double power) {
  const double errors = errors_of(difference.degrees, count, alpha, power);
  return std::exp(limits_of(threshold).high + errors * difference.error) - 1;
}

std::size_t processes_needed(const Difference& difference, std::size_t processes, std::size_t count,
                             double threshold, double alpha, double power) {
  if (difference.assumed) return 0;
  const double distance = place_of(difference, limits_of(threshold)).second;
  const double deviation = difference.error * std::sqrt(double(processes));
  for (std::size_t n = fewest_processes; n <= 1000; ++n) {
    const double errors = errors_of(double(n - 1), count, alpha, power);
    if (errors * deviation / std::sqrt(double(n)) <= distance) return n;
  }
  return 0;
}

}  // namespace pelage
