// A table of the time of the paper's own pipeline (the OpenGL baseline, called rival in file names) divided
// by ours, from an experiment that draws a frame with both pipelines in every round.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// The table has one row per reading and model, and one column per number of layers and picture size.
struct RivalTable {
  struct Entry {
    Cell cell;
    std::optional<Metric>
        ratio;  ///< median over the rounds and its 95% interval; empty unless the cell is ok
    std::optional<double> opengl_ms;  ///< median of the baseline's wall times, ms
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
    double mean = 0;  ///< geometric mean of the ratios
    double least = 0;
    std::string least_cell;
  };
  /// Cost of the scene's curls and clumps: frame time of the reading "default" over that of the reading
  /// "plain".
  struct Overhead {
    std::size_t cells = 0;        ///< number of cells that were timed in both readings
    double ours = 0, opengl = 0;  ///< geometric means over the cells, per pipeline
  };
  std::string experiment, device, host, renderer;
  std::vector<Column> columns;  ///< sorted by layers, then size
  std::vector<Row> rows;        ///< sorted by reading, then triangles
  std::vector<Summary> summary;
  Overhead overhead;
};

/// Returns one table per experiment, device and host whose rows have the metric opengl_ratio. Only cells
/// without overrides are used.
std::vector<RivalTable> rival_tables(const std::vector<FoundRow>& rows);

std::string text_of(const RivalTable& table);
/// Returns one line per cell, for programs and for plots/rivals.py.
std::string csv_of(const RivalTable& table);
std::string html_of(const RivalTable& table);

}  // namespace pelage
