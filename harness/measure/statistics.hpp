// Statistics of timings. Journals store raw samples. The report and the sampler compute these statistics from
// the samples.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "harness/base/median.hpp"
#include "harness/record/row.hpp"

namespace pelage {

struct Interval {
  double low = 0;
  double high = 0;
};

/// Returns an interval that contains the true median with at least the probability `confidence`. The ends of
/// the interval are two of the values. The binomial distribution gives the ranks of these two values, so the
/// interval is valid for any distribution of the values. Fewer than six values have no 95% interval. If there
/// is no interval, returns the whole range of the values.
Interval median_interval(std::span<const double> values, double confidence = 0.95);

/// Returns whether `count` values suffice for an interval of median_interval with this confidence.
bool has_median_interval(std::size_t count, double confidence = 0.95);

/// Returns a bootstrap interval of the median over all samples of several processes. `processes` holds the
/// samples of each process. Samples of one process share memory layout and clock rate. Therefore the function
/// resamples first the processes and then the samples within each drawn process. For one process it returns
/// the result of median_interval.
Interval nested_median_interval(std::span<const std::vector<double>> processes, std::uint64_t seed,
                                double confidence = 0.95, int resamples = 2000);

/// Returns whether `count` values suffice for mean_interval(): three or more.
bool has_mean_interval(std::size_t count);

/// Returns a confidence interval of the mean of independent values, such as values from separate runs. It
/// uses Student's t-distribution. If all values are positive, the function computes the interval from their
/// logarithms. It is then an interval of the geometric mean. Needs at least three values.
Interval mean_interval(std::span<const double> values, double confidence = 0.95);

/// A trend of the times during a run, for instance because the processor became warmer and slower.
struct Drift {
  /// Estimated change from the first to the last sample, as a fraction of the median. The value 0.05 means
  /// that the times increased by 5%. The change is the median slope of all pairs of samples (Theil and Sen),
  /// multiplied by the number of samples minus 1 and divided by the median of the samples.
  double change = 0;
  /// Two-sided p-value of the hypothesis that there is no trend. The test uses Kendall's rank correlation
  /// between a sample's time and its position, with the normal approximation.
  double p = 1;
};

/// Returns the drift of `values`, which must be in the order of measurement. If there are more than 400
/// values, the function uses only 400 of them, evenly spaced. For fewer than eight values it returns the
/// change 0 and the p-value 1.
Drift drift_of(std::span<const double> values);

/// Returns whether a drift is significant: its p-value is below 0.01, and it changes the time by more than
/// 2%.
bool drifts(const Drift& drift);

/// Returns half the width of median_interval, divided by the median.
double relative_half_width(std::span<const double> values, double confidence = 0.95);

/// Returns the median of `values` with its 95% interval (median_interval). There is one value per round of
/// measurements. Needs at least one value.
Metric median_metric(std::span<const double> values, const std::string& unit);

/// Returns the median of the ratios a[i] / b[i] of all rounds i, with its 95% interval. `a` and `b` need the
/// same number of values.
Metric median_ratio(std::span<const double> a, std::span<const double> b);

/// The required precision of the median if the experiment does not state one. A precision is half the width
/// of the median's 95% interval, as a fraction of the median.
inline constexpr double usual_precision = 0.02;

/// Returns whether the median of the row's frame times has a 95% interval that is narrow enough. Half the
/// width of the interval, as a fraction of the median, must be at most the precision that the experiment
/// required (provenance.precision). If the row lacks this field, or if its value is 1 or more,
/// usual_precision is the required precision. The field provenance.converged is ignored, because older
/// versions set it to true if provenance.precision was 1 or more.
bool is_precise(const Row& row);

}  // namespace pelage
