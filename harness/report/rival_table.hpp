// A table of time ratios: the time of the paper's own pipeline (the OpenGL baseline, called rival in file
// names) divided by the time of our OpenCL pipeline. The rows come from an experiment that draws a frame with
// both pipelines in every round.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// The table has one row for each value of the experiment's axis "reading" and each model. A value of this
/// axis names a set of scene settings, for instance "default" or "plain". The table has one column for each
/// number of layers and each picture size.
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
  /// The cost of curls and clumps. The cost is the frame time with the scene settings "default" divided by
  /// the frame time with the settings "plain", which have neither curls nor clumps.
  struct Overhead {
    /// Number of combinations of a model, a number of layers and a picture size for which both pipelines have
    /// a time with the scene settings "default" and a time with the settings "plain".
    std::size_t cells = 0;
    /// Frame time with the settings "default" divided by the frame time with the settings "plain": geometric
    /// mean over these combinations. `ours` is for the OpenCL pipeline, `opengl` is for the OpenGL baseline.
    double ours = 0, opengl = 0;
  };
  std::string experiment, device, host, renderer;
  std::vector<Column> columns;  ///< sorted by layers, then by size
  std::vector<Row> rows;        ///< sorted by the value of "reading", then by number of triangles
  std::vector<Summary> summary;
  Overhead overhead;
};

/// Returns one table for each combination of experiment, device and host. A combination has a table only if
/// at least one of its rows of results has the metric opengl_ratio. Ignores the rows of runs in which --set,
/// --axis or --model changed the experiment.
std::vector<RivalTable> rival_tables(const std::vector<FoundRow>& rows);

std::string text_of(const RivalTable& table);
/// Returns CSV with one line per cell of the table; plots/rivals.py also reads it.
std::string csv_of(const RivalTable& table);
std::string html_of(const RivalTable& table);

}  // namespace pelage
