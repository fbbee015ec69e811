// The cost of each topology on each model: frame and simulation times of all topologies side by side.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// Rows of model x layers x size, columns of topologies.
struct TopologyTable {
  struct Entry {
    Cell cell;
    std::optional<double> simulate_ms, raster_ms;  ///< medians of the phases' event times
    /// Median frame time over that of the row's first topology, which is Silva's strand if the row has it.
    std::optional<double> ratio;
  };
  struct Row {
    std::string model, layers, size;
    double triangles = 0;
    std::vector<std::optional<Entry>> entries;  ///< per topology
  };
  struct Summary {
    std::optional<double> ratio;     ///< geometric mean over the rows
    std::optional<double> simulate;  ///< median share of simulation in the frame, 0..1
    std::optional<double> worst;     ///< largest such share ...
    std::string worst_row;           ///< ... and its row
  };
  std::string experiment, device, host;
  std::vector<std::string> topologies;
  std::vector<Row> rows;  ///< by layers, size, triangles
  std::vector<Summary> summary;
};

/// Returns true for a cell whose experiment has the topology as an axis.
bool has_topology_axis(const Cell& cell);

/// Returns one table per experiment, device and host. It uses the cells without overrides that have the axes
/// model, layers, size and dynamics.topology.
std::vector<TopologyTable> topology_tables(const std::vector<FoundRow>& rows);

std::string text_of(const TopologyTable& table);
/// Returns one line per cell, for programs and for plots/topologies.py.
std::string csv_of(const TopologyTable& table);
std::string latex_of(const TopologyTable& table);
std::string html_of(const TopologyTable& table);

}  // namespace pelage
