// The first lines of a section: what its rows say in one sentence, and which choice is the cheapest for a
// tolerance.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"
#include "harness/table/table.hpp"

namespace pelage {

/// Returns one sentence of result, for instance "OpenCL is 8.79 times as fast as OpenGL (geometric mean of 32
/// cases, 5.18 to 17.6)."; "" without times. `cells` are of one experiment and device.
std::string answer_of(const std::vector<Cell>& cells);

/// Returns the metrics of an error or a likeness by which choices_of() chooses.
std::vector<std::string> qualities_of(const std::vector<Cell>& cells);

/// Returns the settings, of those that vary in the cells, that all control scenes share, for instance "layers
/// 256"; "" if no cell is the same as its control scene.
std::string control_of(const std::vector<Cell>& cells);

/// Returns the name of the axis of a plot for a metric of an error or a likeness, with its unit; "" for other
/// metrics.
std::string words_of(const std::string& metric, const std::vector<Cell>& cells);

/// Returns the two limits of such a metric that answer_of() names; none for other metrics.
std::vector<double> told_limits(const std::string& metric);

/// Returns a table with the cheapest case for each limit of an error or of a likeness of pictures, for
/// experiments that measure one (a metric such as error_rms or baseline_ssim that the view names, or any of
/// them if there is no view) beside times; nothing for others. There is one line for each limit and
/// combination of values of the circumstances: model, size, distance, topology, keys of the camera and
/// View::panels.
std::optional<Table> choices_of(std::vector<Cell> cells);

}  // namespace pelage
