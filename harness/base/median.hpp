// The median, the quantiles and the geometric mean of a list of numbers.
#pragma once
#include <span>

namespace pelage {

/// Returns the median: for an even number of values, the mean of the two middle ones. Needs at least one
/// value.
double median(std::span<const double> values);

/// Returns the median like median(), and changes the order of the values. It needs no copy of the values. The
/// bootstrap calls it millions of times.
double median_reordering(std::span<double> values);

/// Returns the q-quantile, 0 <= q <= 1, interpolated linearly between order statistics (type 7 of Hyndman and
/// Fan). Needs at least one value.
double quantile(std::span<const double> values, double q);

/// Returns the geometric mean; 0 for an empty list.
double geometric_mean(std::span<const double> values);

}  // namespace pelage
