// Metrics that compare the time of a phase with the time of the frame. The name of such a metric says which
// time is divided by which, whatever the name of the phase is.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace pelage {

struct Row;

/// Returns the name of the metric (time of the phase) / (time of the frame): "PHASE_ratio".
std::string ratio_metric(const std::string& phase);

/// Returns the name of the metric (time of the frame) / (time of the phase): "frame_over_PHASE", the cost of
/// a frame relative to the phase, for example to a frame with half of the layers.
std::string frame_over_metric(const std::string& phase);

/// Returns a[i] / b[i] for all rounds i.
std::vector<double> ratios_by_round(std::span<const double> a, std::span<const double> b);

/// Returns the present name of a metric. In rows of schemas 1 and 2, the metrics half_ratio, quarter_ratio
/// and baseline_ratio were the time of the frame divided by the time of the phase, in contrast to all other
/// metrics PHASE_ratio. They are now called frame_over_PHASE. Returns other names unchanged.
std::string present_metric(const std::string& name);

/// Returns present_metric(name) for a name that a user wrote at `place`, and prints a line on stderr if it is
/// old.
std::string present_metric(const std::string& name, const std::string& place);

/// Converts a row of schema 1 or 2 to the names of schema 3: its metrics and the columns in its view
/// (harness/experiment/view.hpp). A row of schema 1 keeps its schema, because it has no identity.
void convert_to_present(Row& row);

}  // namespace pelage
