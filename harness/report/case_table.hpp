// The table of an experiment: one line per case, and a column for each axis, time and metric. The special
// sections of a report use this table too, with more columns and another layout.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"
#include "harness/table/table.hpp"

namespace pelage {

/// A column, and the function that computes its value for a cell. A table has one line per cell.
struct CellColumn {
  Column column;
  std::function<Value(const Cell&)> value;
};

/// Returns the columns in this order. First come the axes: the model, the number of triangles, the other
/// axes, the layers and the size. Then come the variant, the experiment, the device, the host, the settings
/// that the user changed, and the status. Then come the frame rate and the frame time with 95% intervals, the
/// CPU time, the numbers of samples and processes, whether the median converged, and whether other processes
/// disturbed the timing. The last columns are the median time of each phase ("simulate_ms"), and each metric
/// with its interval if it has one. Cells that are not ok have no times, frame rates and metrics. Readers see
/// their status in place of fps and median_ms.
std::vector<CellColumn> case_columns(const std::vector<Cell>& cells);

/// Returns a table with one line per cell. Its layout is empty.
Table table_of(const std::vector<Cell>& cells, const std::vector<CellColumn>& columns);

/// Returns the names of those key columns (axes and variant) that have several values in the table, in the
/// order of the columns.
std::vector<std::string> varying_keys(const Table& table, const std::vector<Cell>& cells);

/// Appends to Layout::rows every key column that varies and that the layout does not contain. Then no two
/// cells with different axes have the same place in the cross table.
void add_varying_keys(Table& table, const std::vector<Cell>& cells);

/// Adds the 95% interval to the text that readers see in the column `name`: "12.3 [12.1, 12.6]". The limits
/// are in the columns NAME_low and NAME_high.
void show_interval(Table& table, const std::string& name);

/// Returns "EXPERIMENT on DEVICE", followed by the properties that all cells have in common. These are values
/// of axes, the variant if it is not the default variant, and the settings that the user changed. If
/// `several_hosts` is true, the host is included.
std::string subtitle_of(const std::vector<Cell>& cells, bool several_hosts);

/// Returns a map from each value of the axis "model" to the model's number of triangles. The number is 0 if
/// no cell of the model contains it.
std::map<std::string, double> triangles_by_model(const std::vector<Cell>& cells);

/// Sorts the cells, because the run measured them in random order. The order is by the number of triangles,
/// then by the values of the axes (model first, layers and size last), then by the variant.
void sort_cells(std::vector<Cell>& cells);

/// Returns the values of the cell's axes as text, for example "torus, 16 layers, 800x600". Omits the variant,
/// and the reading if it is "default".
std::string name_of(const Cell& cell);

/// Returns the marks of the cell's times: "*" if the median did not converge, "!" if other processes
/// disturbed the timing, "*!" for both.
std::string marks_of(const Cell& cell);

/// For each mark (marks_of()) that occurs in these cells, returns one sentence that explains the mark.
std::vector<std::string> mark_remarks(const std::vector<Cell>& cells);

/// Returns a remark that names up to five cases whose times drift (drifts()), and the change of each time:
/// "Times drift during the run: torus, 16 layers, 800x600 (+3.2%)." Returns "" if there is no such case.
std::string drift_remark(const std::vector<Cell>& cells);

}  // namespace pelage
