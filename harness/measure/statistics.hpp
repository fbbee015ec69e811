// Statistics of timings. Journals store raw samples; the report and the sampler compute these values from
// them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "harness/journal/row.hpp"

namespace pelage {

struct Interval {
  double low = 0;
  double high = 0;
};

/// Returns the median: for an even number of values, the mean of the two middle ones. Needs at least one
/// value.
double median(std::span<const double> values);

/// Returns the q-quantile, 0 <= q <= 1, interpolated linearly between order statistics (type 7 of Hyndman and
/// Fan).
double quantile(std::span<const double> values, double q);

/// Returns the interval between two order statistics that contains the median with at least `confidence`. It
/// follows from the binomial distribution and assumes nothing about the shape of the noise. Fewer than six
/// values have no 95% interval; then the whole range is returned.
Interval median_interval(std::span<const double> values, double confidence = 0.95);

/// Returns whether `count` values suffice for median_interval to have that confidence.
bool has_median_interval(std::size_t count, double confidence = 0.95);

/// Returns a bootstrap interval of the median over processes and their samples. Samples of one process share
/// its memory layout and clock, so processes are resampled first, and then the samples within each. For one
/// process the result is that of median_interval.
Interval nested_median_interval(std::span<const std::vector<double>> processes, std::uint64_t seed,
                                double confidence = 0.95, int resamples = 2000);

/// Returns half the width of the median's interval, divided by the median.
double relative_half_width(std::span<const double> values, double confidence = 0.95);

/// Returns the indices of values farther than 5 scaled median absolute deviations from the median. Outliers
/// are reported but never removed.
std::vector<std::size_t> outliers(std::span<const double> values);

/// Returns the median of `values`, one per round, with its 95% interval (median_interval). Needs at least one
/// value.
Metric median_metric(std::span<const double> values, const std::string& unit);

/// Returns the median of the ratios a[i] / b[i] of all rounds i, with its 95% interval. Both need the same
/// number of values.
Metric median_ratio(std::span<const double> a, std::span<const double> b);

}  // namespace pelage
