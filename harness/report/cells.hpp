// Cells of the report's tables. A cell combines the rows of one case from all processes (--repeat) and holds
// the statistics of their samples.
#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/measure/difference.hpp"
#include "harness/record/results_folder.hpp"

namespace pelage {

/// Rows contain this PSNR (dB) for pictures that do not differ, as with a picture and itself.
inline constexpr double decibels_of_equal_pictures = 200;

/// True for a value of the axis "reading" that titles and names leave out.
bool is_usual_reading(std::string_view value);

struct Cell {
  std::string experiment, case_name, variant, device, host;
  std::map<std::string, std::string> axes, overrides;
  Identity identity;           ///< identity of all combined rows (harness/record/identity.hpp)
  Status status = Status::ok;  ///< ok only if all combined rows are ok
  std::string reason;
  std::map<std::string, Metric> metrics;  ///< each metric, combined over the rows (combined_metric())
  /// Name of each metric -> its values, one for each combined row (each from a separate process), in their
  /// order.
  std::map<std::string, std::vector<double>> runs;
  Timings timings;           ///< for each process, its start time and the wall times of its frames
  bool contended = false;    ///< whether a row was timed on a loaded machine (harness/measure/cpu_use.hpp)
  bool interrupted = false;  ///< whether a row has an interruption_warning()
  /// Name of each phase other than "frame" -> median of its times in ms (times_of()).
  std::map<std::string, double> phase_ms;
  std::optional<double> cpu_ms;  ///< median of the CPU times of frames, in ms
  std::string sample;            ///< what one sample is (sample_of())
  std::string title;             ///< title of the experiment; "" for rows of earlier versions
  std::string renderer;          ///< OpenGL renderer; "" if the OpenGL baseline did not run
  nlohmann::json view;           ///< table [report] of the experiment file; null for rows of earlier versions
  double median_ms = 0;          ///< median of all samples of all processes; 0 without samples
  /// 95% interval of the median. The bootstrap resamples the processes and then the samples of each process.
  Interval interval_ms;
  bool converged = true;  ///< whether every row has a narrow interval (is_precise())
  /// Change of the frame time from the first to the last sample, as a fraction of the median (Drift::change),
  /// in the row that drifts most. 0 if no row drifts (drifts()).
  double drift = 0;
  std::filesystem::path image;    ///< file of the cell's picture; it may not exist
  int index = -1;                 ///< index of this cell in the result of cells_of()
  std::vector<std::size_t> rows;  ///< indices of the combined rows in the argument of cells_of()
  /// Hashes of the picture files, from the rows. Empty for rows of earlier versions.
  std::set<std::string> picture_hashes;
  std::set<std::string> pixel_hashes;  ///< hashes of the pixels of the timed pictures; empty without pictures
  /// Value of the axis "reading"; "" for the usual readings: "paper", "default" of rows of earlier versions,
  /// and cells without this axis.
  std::string reading() const;
  std::string axis(const std::string& key) const;  ///< value of the axis; "" if the cell has no such axis
  const Metric* metric(const std::string& name) const;  ///< null if the cell has no such metric
  double fps() const { return 1000 / median_ms; }       ///< only for a cell with a time
};

/// Returns Cell::sample of all cells, "sample" if they differ.
std::string sample_of(const std::vector<Cell>& cells);

/// Whether the cell has enough samples for the interval of its median.
bool has_interval(const Cell& cell);

inline bool timed(const Cell& cell) {
  return cell.status == Status::ok && cell.median_ms > 0;
}

/// Returns the value of the key; nothing if the map has no such key.
template <class Value>
std::optional<Value> found_in(const std::map<std::string, Value>& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? std::nullopt : std::optional(found->second);
}

/// Returns the timed cell of the same variant, device and host that differs from `like` only in the axis, of
/// which it has the value `value`; null if there is none.
const Cell* counterpart(const std::vector<Cell>& cells, const Cell& like, const std::string& axis,
                        const std::string& value);

/// Returns the settings that the user changed on the command line: "fur.length=0.1; size=800x600".
std::string changes_of(const std::map<std::string, std::string>& overrides,
                       std::string_view separator = "; ");

/// Returns the cells sorted by experiment, device and host. The cases of an experiment keep the order in
/// which they first occur in the rows. Only rows with equal identities are combined.
std::vector<Cell> cells_of(const std::vector<FoundRow>& rows);

/// Replaces the frame times in `cells` by the times of the phase `phase` (times_of()). `cells` is the result
/// of cells_of(rows). A cell without this phase has no time afterwards. Throws InputError with the names of
/// all phases if no cell has the phase.
void use_phase(std::vector<Cell>& cells, const std::vector<FoundRow>& rows, const std::string& phase);

/// Our frame rate divided by the frame rate that a paper published. The interval follows from the
/// uncertainties of both; an empty `low` or `high` means that the interval has no such limit.
struct Ratio {
  double value;
  std::string relation;  ///< ">" if the paper gives only an upper bound of its frame rate, else ""
  std::optional<double> low, high;
};
std::optional<Ratio> ratio_of(const Cell& cell);

/// Returns the number in the form in which a paper prints it: "267", "< 1", "~ 30" or "20..30".
std::string published_text(const Metric& figure);

}  // namespace pelage
