// Combines the metrics that several processes measured for the same case.
#pragma once
#include <span>

#include "harness/journal/row.hpp"

namespace pelage {

/// Combines the values of one metric from separate processes. If all values are equal (for example counts, or
/// numbers printed in a paper), returns the first one unchanged. Otherwise returns their median with limits.
/// With three or more processes, the limits are the 95% interval of the mean over the processes
/// (mean_interval()). With two processes, they are the smaller of the two lower limits and the larger of the
/// two upper limits; there are no limits if one process has none. Needs at least one value.
Metric combined_metric(std::span<const Metric> values);

}  // namespace pelage
