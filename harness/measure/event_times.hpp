// Tests the event times of a case against its wall times. A driver may report a timer resolution although its
// event timer does not measure time; harness/cl/timer.hpp tests the timer of a device for `pelage devices`.
#pragma once
#include <map>
#include <string>

#include "harness/journal/row.hpp"

namespace pelage {

/// Returns why the event times cannot be times of the frames whose wall times are recorded with them: "" if
/// they can. Event times are implausible if
/// - some frames have none,
/// - their median is above the median wall time (plus 10% for the drift between the clocks),
/// - their median is below 0.01% of the median wall time, or
/// - they are equal in six or more frames whose wall times differ.
std::string implausible_events(const std::map<std::string, PhaseSamples>& samples);

/// Removes implausible event times from the row, and the phases that have no other times. Writes the reason
/// to the entry event_times of its provenance.
void remove_implausible_events(Row& row);

}  // namespace pelage
