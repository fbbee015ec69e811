// Metrics of a cell that combines the rows of several processes.
#pragma once
#include <span>

#include "harness/journal/row.hpp"

namespace pelage {

/// Combines the values that separate processes measured for one metric. Returns the first value unchanged if
/// all values are equal, as for counts and for numbers printed in a paper. Otherwise the value is the median.
/// The limits then are a 95% interval of the processes' mean (mean_interval()) from three processes on. With
/// two processes they are the least lower and the greatest upper limit, if both processes have limits. Needs
/// at least one value.
Metric combined_metric(std::span<const Metric> values);

}  // namespace pelage
