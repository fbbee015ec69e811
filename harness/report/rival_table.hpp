// A table of time ratios: the time of the paper's own pipeline (the OpenGL baseline, called rival in file
// names) divided by the time of our OpenCL pipeline. The rows come from an experiment that draws a frame with
// both pipelines in every round.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// The table has one row per reading (value of the axis "reading") and model. It has one column per number of
/// layers and picture size.
struct RivalTable {
  struct Entry {
    Cell cell;
    std::optional<Metric>
        ratio;  ///< median over the rounds, with its 95% interval; empty if the cell is not ok
    std::optional<double> opengl_ms;  ///< median of the OpenGL baseline's wall times, ms
  };
  struct Column {
    std::string layers, size;
  };
  struct Row {
    std::string reading, model;
    double triangles = 0;
    std::vector<std::optional<Entry>> entries;  ///< one per column
  };
  struct Summary {
    std::string reading;
    std::size_t cells = 0, timed = 0;
    double mean = 0;  ///< geometric mean of the ratios over the cells
    double least = 0;
    std::string least_cell;
  };
  /// The cost of curls and clumps: the frame time with the scene settings "default" divided by that with
  /// "plain", which has neither curls nor clumps.
  struct Overhead {
    std::size_t cells = 0;        ///< number of cells that have times with both settings
    double ours = 0, opengl = 0;  ///< geometric means of the cost over the cells, for our pipeline and OpenGL
  };
  std::string experiment, device, host, renderer;
  std::vector<Column> columns;  ///< sorted by layers, then by size
  std::vector<Row> rows;        ///< sorted by the value of "reading", then by number of triangles
  std::vector<Summary> summary;
  Overhead overhead;
};

/// Returns one table per experiment, device and host whose rows have the metric opengl_ratio. Uses only cells
/// without overrides.
std::vector<RivalTable> rival_tables(const std::vector<FoundRow>& rows);

std::string text_of(const RivalTable& table);
/// Returns CSV with one line per cell of the table; plots/rivals.py also reads it.
std::string csv_of(const RivalTable& table);
std::string html_of(const RivalTable& table);

}  // namespace pelage
