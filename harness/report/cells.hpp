// Cells of a report: the rows of one case, combined over processes, with the statistics of their samples.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"
#include "harness/measure/statistics.hpp"

namespace pelage {

struct Cell {
  std::string experiment, case_name, variant, device, host;
  std::map<std::string, std::string> axes, overrides;
  Status status = Status::ok;  ///< ok only if every row of it is
  std::string reason;
  std::map<std::string, Metric> metrics;           ///< of the first row
  std::vector<std::vector<double>> processes;      ///< frame wall times, ms, one list per row
  double median_ms = 0;                            ///< over all samples of all processes; 0 without samples
  Interval interval_ms;                            ///< 95%, processes resampled first
  bool converged = true;                           ///< every row reached its preset's precision
  std::filesystem::path image;                     ///< the picture of this cell; may not exist
  std::string reading() const;                     ///< "default" if the experiment has no such axis
  std::string axis(const std::string& key) const;  ///< "" without such an axis
  std::optional<Metric> paper_fps() const;
  double fps() const { return median_ms > 0 ? 1000 / median_ms : 0; }
};

/// Returns cells sorted by experiment, device and host; cases keep the order of their first appearance.
std::vector<Cell> cells_of(const std::vector<FoundRow>& rows);

/// Our frames per second over the paper's, with the interval from the uncertainties of both (empty end:
/// unbounded).
struct Ratio {
  double value = 0;
  std::string relation;  ///< "", or ">" if the paper gives only an upper bound
  std::optional<double> low, high;
};
std::optional<Ratio> ratio_of(const Cell& cell);

/// Returns the figure as published: "267", "< 1", "~ 30", "20..30".
std::string published_text(const Metric& figure);

}  // namespace pelage
