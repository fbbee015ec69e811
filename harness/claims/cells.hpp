// Selects the cases that decide a claim and their rows of results, and computes the claim's quantity for one
// cell from its samples, and from resampled samples for bootstrap intervals.
#pragma once
#include <boost/random/normal_distribution.hpp>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "harness/claims/claim.hpp"
#include "harness/record/results_folder.hpp"

namespace pelage::claims {

/// One case of the claim, measured on one device. If Claim::phases is not empty, each of these phases is a
/// separate cell.
struct Cell {
  std::string name;  ///< name of the case, with the phase if the claim has phases
  /// Axis -> value, with "variant" and "experiment".
  std::map<std::string, std::string> axes;
  std::string phase;  ///< phase whose times count as frame times: "frame", or one of `phases`
  /// The rows of the case, one per process. They belong to the caller of cells_of() and must outlive the
  /// cell.
  std::vector<const Row*> processes;
  std::size_t contended = 0;  ///< rows with a load_warning() or an interruption_warning() (harness/measure)
};

struct Cells {
  std::vector<Cell> cells;
  /// Names of the selected cases that are not used, each with the reason in round brackets: a row of the case
  /// lacks the values from which the claim's quantity is computed.
  std::vector<std::string> left_out;
  /// Number of rows with such a warning.
  std::size_t contended = 0;
};

/// Returns the cells of the claim in the order of the rows, which must be from its experiments, and from one
/// device and host. All rows of a case must have been measured with the same inputs (input_sets()).
Cells cells_of(const Claim& claim, const std::vector<const Row*>& rows);

/// Returns one sentence for each axis value in Claim::where, `of` and `to` that no row has, and for each axis
/// that no row has.
std::vector<std::string> unknown_values(const Claim& claim, const std::vector<const Row*>& rows);

/// The quantity of a cell. `frame` is the frame time in ms; only the effect ratio_by_phase uses it.
struct Value {
  double value, frame;
};

/// Bootstrap draws of the quantity of one cell. A draw chooses processes with replacement, and then samples
/// of each chosen process with replacement. If fewer than `separate_processes` processes measured the cell,
/// it also multiplies the times of every chosen process by a log-normal factor with the relative standard
/// deviation `spread`, for the unknown spread between processes; likewise a metric with the unit ms, 1/s, fps
/// or "times" (a ratio), but no count. A metric with a 95% interval is drawn from a normal distribution with
/// this interval. The random seed depends only on the experiment, the case and the variant. Equal arguments
/// therefore give equal draws, and all phases of a case use the same processes, samples and factors.
class Drawing {
 public:
  Drawing(const Claim& claim, const Cell& cell, double spread, int separate_processes);
  Value measured();  ///< the quantity, from all samples of all processes
  Value drawn();

 private:
  struct Process {
    std::vector<double> times, phase_times;  // ms; `phase_times` is empty if the claim uses no phase
    double metric = 0, metric_deviation = 0, per = 1;
  };
  Value value_of_pools();

  const Claim& claim_;
  std::vector<Process> processes_;
  bool measured_metric_ = false;
  double spread_ = 0;
  std::mt19937_64 random_;
  boost::random::normal_distribution<double> normal_;
  std::vector<double> times_, phase_times_, metrics_;  // all samples of the current draw
};

/// Draws of the quantity of a cell from the frame rate that the experiment's paper publishes (the metric
/// paper_fps), uniformly distributed between the limits of this metric, which follow from the rounding of the
/// published number. For a published bound such as "< 1", the limits are 0 and the bound.
class PaperDrawing {
 public:
  /// Whether the paper publishes a number from which the quantity of this cell follows.
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
