// Makes the sections of a report. A section is a table with the results of one experiment on one device, and
// the plots of this table. Every cell (harness/report/cells.hpp) is in a section. A view is the table
// [report] of an experiment file. The axis "reading" of an experiment selects a set of scene settings.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/experiment.hpp"
#include "harness/report/cells.hpp"
#include "harness/report/plot_spec.hpp"
#include "harness/table/table.hpp"

namespace pelage {

struct Section {
  Table table;
  std::vector<PlotSpec> plots;
};

/// A function that returns the footnote of a model, or "" if the model has no footnote.
using ModelNote = std::function<std::string(const std::string& model)>;

/// Data that the functions below need for every section of a report.
struct Sources {
  ModelNote note;
  bool several_devices = false,  ///< true: file names contain the device
      several_hosts = false;     ///< true: file names and subtitles contain the host
  /// Notes of the report. The functions add a note for each name in a view that is not a column of the table.
  std::vector<std::string>* notes = nullptr;
};

/// Returns the sections of all cells: one or more for each experiment, device and host. Cells whose settings
/// the user changed with --set, --axis or --model have separate sections. The subtitles of these sections
/// name the changes.
std::vector<Section> sections_of(const std::vector<Cell>& cells, const Sources& sources);

/// The following functions return the sections of one group of cells. All cells of the group have the same
/// experiment, device, host and overrides (settings that the user changed). `stem` is the start of the
/// sections' file names.

/// For any experiment: a table with one row per case, and a plot of the frame time.
std::vector<Section> case_sections(const std::vector<Cell>& cells, const std::string& stem,
                                   const Sources& sources);
/// For cells with a frame rate that a paper published: tables with the layout of the paper's table. There is
/// one table for each variant and each value of the axis "reading". Each table contains our frame rate, the
/// paper's frame rate and their ratio.
std::vector<Section> paper_sections(const std::vector<Cell>& cells, const std::string& stem,
                                    const Sources& sources);
/// For cells with the metric opengl_ratio (frame time of the OpenGL baseline divided by the frame time of our
/// OpenCL pipeline): a table of these ratios, and their geometric means.
std::vector<Section> ratio_sections(const std::vector<Cell>& cells, const std::string& stem,
                                    const Sources& sources);
/// For cells with the axes dynamics.topology and layers: a table of the frame time and the simulation time of
/// each topology. A second table has one line per topology. Each line contains the topology's frame time
/// divided by the frame time of the first topology, and the simulation's share of the frame time.
std::vector<Section> topology_sections(const std::vector<Cell>& cells, const std::string& stem,
                                       const Sources& sources);

/// Returns the experiment with this name from pelage's experiment files. Returns nothing if there is no such
/// file, or if it cannot be read.
std::optional<Experiment> shipped_experiment(const std::string& name);

/// Returns the title of the cells' experiment from the rows. If the rows contain no title, takes it from the
/// experiment file that shipped_experiment() reads. If this file has no title either, returns the name of the
/// experiment.
std::string title_of(const std::vector<Cell>& cells);

struct CellColumn;

/// Returns a section whose table has one line per cell, and the title, the subtitle and the file name of the
/// table.
Section section_of(const std::vector<Cell>& cells, const std::vector<CellColumn>& columns,
                   const std::string& stem, const Sources& sources);

/// Returns those of `names` that are columns of the table.
std::vector<std::string> present(const Table& table, const std::vector<std::string>& names);

/// Adds the footnotes about models to the table, and marks these models in the row headings. If the row
/// headings do not contain the models, adds the texts of the footnotes as remarks instead.
void add_footnotes(Table& table, const ModelNote& note);

/// Returns the geometric mean; 0 for an empty list.
double geometric_mean(const std::vector<double>& numbers);

/// Returns the view (the table [report] of the experiment file) from the rows of the cells. Rows of earlier
/// versions of pelage do not contain the view. For such rows, returns the view of the experiment that
/// shipped_experiment() reads.
View view_of(const std::vector<Cell>& cells);

}  // namespace pelage
