// Combines the metrics that several processes measured for the same case.
#pragma once
#include <span>

#include "harness/journal/row.hpp"

namespace pelage {

/// Combines the values of one metric from separate processes. If all values are equal (for example counts, or
/// numbers printed in a paper), or if a value is not finite, returns the first metric unchanged. Otherwise
/// returns their median with limits. With three or more processes, the limits are the 95% interval of the
/// mean over the processes (mean_interval()). With two processes, the lower limit is the smaller one of their
/// lower limits, and the upper limit is the larger one of their upper limits. If a limit is missing in one
/// process, the result has no limits. Needs at least one value.
Metric combined_metric(std::span<const Metric> values);

}  // namespace pelage
