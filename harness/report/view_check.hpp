// Checks the names in the table [report] of an experiment file before its cases run.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "harness/experiment/view.hpp"

namespace pelage {

/// Returns one warning for each name in the view that is not a column of a case table but resembles one:
/// "report.y names the column medan_ms, which is neither an axis nor a time of the table; did you mean
/// median_ms?". The axes are those of a case. The names of phases and metrics are known only after the run,
/// so a name that resembles no known column gives no warning.
std::vector<std::string> view_warnings(const View& view, const std::map<std::string, std::string>& axes);

}  // namespace pelage
