// The table of an experiment: one line per case, and a column for each time, each metric and each axis.
// Readers see the lines as a cross table (harness/table/table.hpp). All report sections about experiments
// (sections.hpp) use this table; some add columns or change the layout.
#pragma once
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "harness/experiment/view.hpp"
#include "harness/report/cells.hpp"
#include "harness/table/table.hpp"

namespace pelage {

/// A column, and the function that computes its value for a cell.
struct CellColumn {
  Column column;
  std::function<Value(const Cell&)> value;
};

/// Returns the columns: first the axes (the model, its number of triangles, the other axes, the layers and
/// the size), then what else names a case, the status, the frame rate and the frame time with 95% intervals,
/// the CPU time, and the quality of the timing; then the median time of each phase (for the phase "simulate",
/// the column "simulate_ms"), and each metric with its interval if it has one. If the status of a cell is not
/// "ok", its line contains no time, frame rate or metric. Readers then see the status in the columns fps and
/// median_ms.
std::vector<CellColumn> case_columns(const std::vector<Cell>& cells);

/// Returns a table with one line per cell. Its layout is empty.
Table table_of(const std::vector<Cell>& cells, const std::vector<CellColumn>& columns);

bool has_column(const Table& table, std::string_view name);

/// Returns the values of the column, which must exist.
std::set<std::string> values_of(const Table& table, const std::string& column);

/// Whether the column is an axis of the cells, or "variant".
bool is_key(const std::string& column, const std::vector<Cell>& cells);

/// Returns the names of those axes and "variant" that have several values in the table, in the order of the
/// columns.
std::vector<std::string> varying_keys(const Table& table, const std::vector<Cell>& cells);

/// Appends varying_keys() that the layout lacks to Layout::rows, so that each case has its own place in the
/// cross table.
void add_varying_keys(Table& table, const std::vector<Cell>& cells);

/// Adds the 95% interval, from the columns `name` + "_low" and `name` + "_high" if they exist, to the text
/// that readers see in the column `name`: "12.3 [12.1, 12.6]".
void show_interval(Table& table, const std::string& name);

/// Returns "EXPERIMENT on DEVICE", followed by what all cells have in common: values of axes, the variant if
/// it is not the default variant, the settings that the user changed, and the host if `several_hosts` is
/// true.
std::string subtitle_of(const std::vector<Cell>& cells, bool several_hosts);

/// Sorts the cells, because the run measured them in random order. The order is by the number of triangles,
/// then by the values of the axes (model first, layers and size last), then by the variant.
void sort_cells(std::vector<Cell>& cells);

/// Returns the values of the cell's axes as text, for example "torus, curl.radius 0.02, 16 layers, 800x600".
/// A number has the name of its axis. The text does not contain the variant, nor a usual reading, nor
/// the axis `but`.
std::string name_of(const Cell& cell, const std::string& but = "");

/// Returns the marks of the cell's times: "*" if the median did not converge, "!" if other processes
/// disturbed the timing, "*!" for both.
std::string marks_of(const Cell& cell);

/// Returns " [low, high]" of a ratio; "" if it has no interval, because it is that of a single round.
std::string interval_text(const Metric& ratio);

/// Returns the sentence that explains the mark "!" of a time.
std::string contended_remark();

/// Returns one sentence for each mark (marks_of()) that occurs in these cells.
std::vector<std::string> mark_remarks(const std::vector<Cell>& cells);

/// Returns a remark that names up to five cases whose times drift (drifts()): "Times drift during the run:
/// torus, 16 layers, 800x600 (+3.2%)." Returns "" if there is no such case.
std::string drift_remark(const std::vector<Cell>& cells);

/// Returns a remark that names cases of one variant whose pictures have equal pixels (equal_pictures()).
/// Returns "" if there are no such cases.
std::string equal_pictures_remark(const std::vector<Cell>& cells);

/// Returns one warning for each name in the view that is not a column of a case table but resembles one:
/// "report.y names the column medan_ms, which is neither an axis nor a time of the table; did you mean
/// median_ms?". The axes are those of a case. The names of phases and metrics are known only after the run,
/// so a name that resembles no known column gives no warning. Throws InputError for a scene key that is no
/// axis, and for such an x, because a report could not draw it.
std::vector<std::string> view_warnings(const View& view, const std::map<std::string, std::string>& axes);

/// The picture of one case, compared with others because equal pixels usually show that a setting has no
/// effect, for instance a wetness without droplets.
struct CasePicture {
  std::string name;   ///< name of the case in the text that equal_pictures() returns
  std::string group;  ///< only pictures of one group are compared, for instance those of one variant
  std::string hash;   ///< hash of the pixels; "" if the case has no picture
};

/// Returns a sentence that names up to five sets of cases with equal pictures: "Equal pictures: (dry) and
/// (soaked). The settings in which these cases differ change no pixel."; "" if all differ. Pictures with the
/// same name count as one.
std::string equal_pictures(const std::vector<CasePicture>& pictures);

}  // namespace pelage
