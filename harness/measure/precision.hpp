// Decides from the samples of a row whether the median of its frame times is precise enough.
#pragma once
#include "harness/record/row.hpp"

namespace pelage {

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
