// A table of the cost of each mass-spring topology on each model: the frame and simulation times.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

/// The table has one row per model, number of layers and picture size, and one column per topology.
struct TopologyTable {
  struct Entry {
    Cell cell;
    /// Median event times of the simulation and of the rasterization, ms.
    std::optional<double> simulate_ms, raster_ms;
    /// Median frame time divided by the median frame time of the first topology in the table row. The first
    /// topology is "silva" if the row contains it.
    std::optional<double> ratio;
  };
  struct Row {
    std::string model, layers, size;
    double triangles = 0;
    std::vector<std::optional<Entry>> entries;  ///< one per topology
  };
  struct Summary {
    std::optional<double> ratio;     ///< geometric mean of Entry::ratio over the table rows
    std::optional<double> simulate;  ///< median over the table rows of the ratio simulation time / frame time
    std::optional<double> worst;  ///< maximum over the table rows of the ratio simulation time / frame time
    std::string worst_row;        ///< name of the table row in which simulation time / frame time is largest
  };
  std::string experiment, device, host;
  std::vector<std::string> topologies;
  std::vector<Row> rows;  ///< sorted by layers, size and triangles
  std::vector<Summary> summary;
};

/// Returns true for a cell whose experiment varies dynamics.topology.
bool has_topology_axis(const Cell& cell);

/// Returns one table per experiment, device and host. An experiment has a table if its axes include model,
/// layers, size and dynamics.topology. The function omits rows whose case was changed on the command line
/// (--set, --axis,
/// --model).
std::vector<TopologyTable> topology_tables(const std::vector<FoundRow>& rows);

std::string text_of(const TopologyTable& table);
/// Returns CSV with one line per cell of the table; plots/topologies.py also reads it.
std::string csv_of(const TopologyTable& table);
std::string latex_of(const TopologyTable& table);
std::string html_of(const TopologyTable& table);

}  // namespace pelage
