// Quantities of a cell: as measured, and as resampled for the bootstrap intervals of effects.
#pragma once
#include <boost/random/normal_distribution.hpp>
#include <random>
#include <vector>

#include "harness/claims/cells.hpp"

namespace pelage::claims {

/// The quantity of a cell. `frame` is the frame time in ms; only the effect ratio_by_phase uses it.
struct Value {
  double value = 0, frame = 0;
};

/// Draws the quantity of one cell. A draw chooses processes with replacement, then samples of each chosen
/// process with replacement. If the cell was measured by fewer than `separate_processes` processes, the times
/// of every chosen process are also multiplied by a random factor with the relative standard deviation
/// `spread` (log-normal), which represents the unknown spread between processes. Metrics with the unit ms,
/// 1/s, fps or times get this factor too; other metrics, such as counts, do not. If the row has a 95%
/// interval of the metric, the metric is drawn from a normal distribution with this interval. The same cell
/// and `spread` always give the same draws. Cells of the same case draw the same processes, samples and
/// factors.
class Drawing {
 public:
  Drawing(const Claim& claim, const Cell& cell, double spread, int separate_processes);
  Value measured();  ///< from all samples of all processes
  Value drawn();

 private:
  struct Process {
    std::vector<double> times, phase_times;  // ms; `phase_times` is empty if the claim uses no phase
    double metric = 0, metric_deviation = 0, per = 1;
  };
  Value value_of_pools();
  double factor();

  const Claim& claim_;
  std::vector<Process> processes_;
  bool measured_metric_ = false;
  double spread_ = 0;
  std::mt19937_64 random_;
  boost::random::normal_distribution<double> normal_;
  std::vector<double> times_, phase_times_, metrics_;  // all samples of the present draw
};

/// Draws the quantity of a cell from the number that the paper publishes for it (the metric paper_fps). The
/// draws are uniform between the limits that the rounding of this number permits.
class PaperDrawing {
 public:
  /// Returns whether the paper gives a number for the quantity of this cell.
  static bool possible(const Claim& claim, const Cell& cell);
  PaperDrawing(const Claim& claim, const Cell& cell);
  Value measured() const;
  Value drawn();

 private:
  Value value_of(double rate) const;
  const Claim& claim_;
  double rate_, low_, high_;  // frames per second
  std::mt19937_64 random_;
};

}  // namespace pelage::claims
