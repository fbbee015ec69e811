// Statistics of timings, which the report and the sampler compute from raw samples.
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

/// Returns an interval that contains the true median with at least the probability `confidence`, whatever the
/// distribution of the values. Its ends are two of the values, whose ranks follow from the binomial
/// distribution. Fewer than six values have no 95% interval. If there is no interval, returns the whole range
/// of the values.
Interval median_interval(std::span<const double> values, double confidence = 0.95);

/// Returns whether `count` values suffice for an interval of median_interval with this confidence.
bool has_median_interval(std::size_t count, double confidence = 0.95);

/// Returns a bootstrap interval of the median over all samples of several processes; for one process,
/// median_interval(). Samples of one process share memory layout and clock rate. Therefore the function
/// resamples first the processes and then the samples within each drawn process.
Interval nested_median_interval(std::span<const std::vector<double>> processes, std::uint64_t seed,
                                double confidence = 0.95, int resamples = 2000);

/// Returns whether `count` values suffice for mean_interval(): three or more.
bool has_mean_interval(std::size_t count);

/// Returns a confidence interval of the mean of three or more independent values (Student's t), such as
/// values from separate runs. If all values are positive, it is computed from their logarithms and is an
/// interval of the geometric mean.
Interval mean_interval(std::span<const double> values, double confidence = 0.95);

/// A trend of the times during a run, for instance because the processor became warmer and slower.
struct Drift {
  /// Estimated change from the first to the last sample, as a fraction of the median (0.05: the times
  /// increased by 5%): the median slope of all pairs of samples (Theil and Sen), multiplied by the number of
  /// samples minus 1 and divided by the median of the samples.
  double change = 0;
  /// Two-sided p-value of the hypothesis that there is no trend: Kendall's rank correlation between a
  /// sample's time and its position, with the normal approximation.
  double p = 1;
};

/// Returns the drift of `values` in the order of measurement. Of more than 400 values it uses 400, evenly
/// spaced. Fewer than eight have the change 0 and the p-value 1.
Drift drift_of(std::span<const double> values);

/// Whether the p-value is below 0.01, and the drift changes the time by more than 2%.
bool drifts(const Drift& drift);

/// Returns half the width of median_interval, divided by the median.
double relative_half_width(std::span<const double> values, double confidence = 0.95);

/// Returns the median of values, one per round of measurements, with its 95% interval (median_interval).
Metric median_metric(std::span<const double> values, const std::string& unit);

/// Returns the median_metric() of the ratios a[i] / b[i] of all rounds i.
Metric median_ratio(std::span<const double> a, std::span<const double> b);

/// Returns whether half the width of the 95% interval of the row's frame times, as a fraction of their
/// median, is at most the precision that the experiment required (provenance.precision), or 0.02 if the row
/// lacks this field or its value is 1 or more. The field provenance.converged is ignored, because older
/// versions set it to true in the latter case.
bool is_precise(const Row& row);

}  // namespace pelage
