// Speed ratios to the paper's own pipeline (the OpenGL baseline, called rival in file names), from an
// experiment that draws with both in turns.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// Rows of reading x model, columns of layers x size.
struct RivalTable {
  struct Entry {
    Cell cell;
    std::optional<Metric> ratio;      ///< median over the rounds and its 95% interval; only if the cell is ok
    std::optional<double> opengl_ms;  ///< median
  };
  struct Column {
    std::string layers, size;
  };
  struct Row {
    std::string reading, model;
    double triangles = 0;
    std::vector<std::optional<Entry>> entries;  ///< per column
  };
  struct Summary {
    std::string reading;
    std::size_t cells = 0, timed = 0;
    double mean = 0;  ///< geometric, over the cells with a ratio
    double least = 0;
    std::string least_cell;
  };
  /// The cost of the scene's curls and clumps: frame time of "default" over that of "plain" shells.
  struct Overhead {
    std::size_t cells = 0;        ///< number of cells in which both were timed
    double ours = 0, opengl = 0;  ///< geometric means
  };
  std::string experiment, device, host, renderer;
  std::vector<Column> columns;  ///< by layers, size
  std::vector<Row> rows;        ///< by reading, triangles
  std::vector<Summary> summary;
  Overhead overhead;
};

/// Returns one table per experiment, device and host with rows that have opengl_ratio. It uses the cells
/// without overrides.
std::vector<RivalTable> rival_tables(const std::vector<FoundRow>& rows);

std::string text_of(const RivalTable& table);
/// Returns one line per cell, for programs and for plots/rivals.py.
std::string csv_of(const RivalTable& table);
std::string html_of(const RivalTable& table);

}  // namespace pelage
