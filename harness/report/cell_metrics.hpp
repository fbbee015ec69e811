// Combines the metrics that several processes measured for the same case.
#pragma once
#include <span>

#include "harness/record/row.hpp"

namespace pelage {

/// Combines the values of one metric from separate processes. If all values are equal (for example counts, or
/// numbers printed in a paper), or if a value is not finite, returns the first metric unchanged. Otherwise
/// returns the median of the values with limits. With three or more processes, the limits are the 95%
/// interval of the mean over the processes (mean_interval()). With two processes, the limits are the smaller
/// one of the two lower limits and the larger one of the two upper limits. If one of the two processes has no
/// limits, the result has no limits. Needs at least one value.
Metric combined_metric(std::span<const Metric> values);

}  // namespace pelage
