// What a report shows: rows of one case put together over processes, with the statistics derived from their
// samples.
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
  std::map<std::string, Metric> metrics;       ///< of the first row
  std::vector<std::vector<double>> processes;  ///< frame wall times, ms, one list per row
  double median_ms = 0;                        ///< over all samples of all processes; 0 when there is none
  Interval interval_ms;                        ///< 95%, processes resampled first
  bool converged = true;                       ///< every row reached its preset's precision
  std::filesystem::path image;                 ///< the picture that belongs to it; may not exist
  std::string reading() const;                 ///< "default" when the experiment has no such axis
  std::string axis(const std::string& key) const;  ///< "" when it has no such axis
  std::optional<Metric> paper_fps() const;
  double fps() const { return median_ms > 0 ? 1000 / median_ms : 0; }
};

/// Cells in the order in which their cases first appear, sorted by experiment, device and host.
std::vector<Cell> cells_of(const std::vector<FoundRow>& rows);

/// Ours over the paper's frames per second, with the interval that both leave open (empty end: unbounded).
struct Ratio {
  double value = 0;
  std::string relation;  ///< "", or ">" when the paper gives an upper bound only
  std::optional<double> low, high;
};
std::optional<Ratio> ratio_of(const Cell& cell);

/// "267", "< 1", "~ 30", "20..30": as published.
std::string published_text(const Metric& figure);

}  // namespace pelage
