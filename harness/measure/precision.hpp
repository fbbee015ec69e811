// Decides whether the median of a row's frame times is precise, from the samples of the row.
#pragma once
#include "harness/journal/row.hpp"

namespace pelage {

/// The precision that counts if the experiment asks for none: half the width of the median's 95% interval as
/// a fraction of the median.
inline constexpr double usual_precision = 0.02;

/// Returns whether the row has frame times with a 95% interval of the median, and half the width of this
/// interval is at most the precision that the experiment asked for (provenance.precision). usual_precision
/// applies to rows of earlier versions, which do not contain this field, and to a precision of 1 or more,
/// which asks for nothing. The field provenance.converged of earlier versions is ignored, because it was true
/// for every row with such a precision.
bool is_precise(const Row& row);

}  // namespace pelage
