// The table of any experiment: one line per case, with a column for each axis, time and metric. The other
// tables of a report are this table with more columns and another layout.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"
#include "harness/table/table.hpp"

namespace pelage {

/// A column of a table with one line per cell.
struct CellColumn {
  Column column;
  std::function<Value(const Cell&)> value;
};

/// Returns the columns in this order: the axes (model first, layers and size last; the number of triangles
/// follows the model), the variant, the experiment, the device, the host, the settings that the user changed
/// and the status; the frame rate and the frame time with 95% intervals, the CPU time, the numbers of samples
/// and processes, whether the median converged, and whether other processes disturbed the timing; the median
/// time of each phase ("simulate_ms"); each metric, with its interval if it has one. Cells that are not ok
/// have no times, rates and metrics; in place of fps and median_ms, readers see the status.
std::vector<CellColumn> case_columns(const std::vector<Cell>& cells);

/// Returns a table with one line per cell and without a layout.
Table table_of(const std::vector<Cell>& cells, const std::vector<CellColumn>& columns);

/// Returns the names of those key columns (axes and variant) that have several values in the table, in the
/// order of the columns.
std::vector<std::string> varying_keys(const Table& table, const std::vector<Cell>& cells);

/// Completes the layout: every key column that varies and is not in the layout is appended to the layout's
/// rows. Then no two cells with different axes have the same place.
void add_varying_keys(Table& table, const std::vector<Cell>& cells);

/// Adds the 95% interval to the shown values of a column: "12.3 [12.1, 12.6]". The limits are the values of
/// the columns NAME_low and NAME_high.
void show_interval(Table& table, const std::string& name);

/// Returns "EXPERIMENT on DEVICE", followed by what all cells share: the host if `several_hosts`, values of
/// axes, the variant if it is not the default one, and the settings that the user changed.
std::string subtitle_of(const std::vector<Cell>& cells, bool several_hosts);

/// Returns the number of triangles of each model; 0 if no cell of the model contains this number. Every value
/// of the axis "model" has an entry.
std::map<std::string, double> triangles_by_model(const std::vector<Cell>& cells);

/// Sorts the cells: by the number of triangles, then by the values of the axes (model first, layers and size
/// last) and by the variant, so that the lines of a table do not depend on the random order of the run.
void sort_cells(std::vector<Cell>& cells);

/// Returns "torus, 16 layers, 800x600": the values of the cell's axes, without the variant and without the
/// reading "default".
std::string name_of(const Cell& cell);

/// Returns the marks of the cell's times: "*" if the median did not converge, "!" if other processes
/// disturbed the timing, "*!" for both.
std::string marks_of(const Cell& cell);

/// Returns the sentences that explain those marks that times of these cells have.
std::vector<std::string> mark_remarks(const std::vector<Cell>& cells);

/// Returns a remark that names the cases whose times drift (drifts()), with the change of each: "Times drift
/// during the run: torus, 16 layers, 800x600 (+3.2%)."; "" if there is none. Names at most five cases.
std::string drift_remark(const std::vector<Cell>& cells);

}  // namespace pelage
