// Statistics of timings. Raw samples are stored; these are what the report and the sampler derive from them.
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

/// Middle value (mean of the two middle ones for an even count). Needs at least one value.
double median(std::span<const double> values);

/// Value below which the fraction q of [0,1] lies, linear between order statistics (Hyndman and Fan's type
/// 7).
double quantile(std::span<const double> values, double q);

/// Interval of order statistics that holds the median with at least `confidence`, from the binomial
/// distribution: no assumption on the shape of the noise. With fewer than six values no 95% interval exists:
/// the whole range is given.
Interval median_interval(std::span<const double> values, double confidence = 0.95);

/// Whether median_interval really has that confidence (enough values).
bool has_median_interval(std::size_t count, double confidence = 0.95);

/// Bootstrap interval of the median over processes and samples: processes are resampled first, then the
/// samples within each, because samples of one process share its memory layout and clock. One process falls
/// back to median_interval.
Interval nested_median_interval(std::span<const std::vector<double>> processes, std::uint64_t seed,
                                double confidence = 0.95, int resamples = 2000);

/// Half the interval's width over the median.
double relative_half_width(std::span<const double> values, double confidence = 0.95);

/// Indices of values farther than 5 scaled median absolute deviations from the median: flagged, never
/// deleted.
std::vector<std::size_t> outliers(std::span<const double> values);

/// The median of what was measured round by round, with its 95% interval (median_interval). Needs a value.
Metric median_metric(std::span<const double> values, const std::string& unit);

/// The same of a / b in every round; as many of each.
Metric median_ratio(std::span<const double> a, std::span<const double> b);

}  // namespace pelage
