// Tests whether the OpenCL event times of a case are plausible, given its wall times. Some drivers return
// event times that are unrelated to the duration of the kernels. harness/cl/timer.hpp has another test.
#pragma once
#include <map>
#include <string>

#include "harness/record/row.hpp"

namespace pelage {

/// Returns the reason why the event times are implausible, or "" if they are plausible. Event times are
/// implausible if
/// - some frames have none,
/// - their median is above the median wall time (plus 10% for the drift between the clocks),
/// - their median is below 0.01% of the median wall time, or
/// - they are equal in six or more frames whose wall times differ.
std::string implausible_events(const std::map<std::string, PhaseSamples>& samples);

/// Removes implausible event times of the row, and phases that then have no times, and writes the reason into
/// the entry "event_times" of the provenance.
void remove_implausible_events(Row& row);

}  // namespace pelage
