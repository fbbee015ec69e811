// Makes the sections of a report. A section is a table with the results of one experiment on one device, and
// the plots of this table. Every cell (harness/report/cells.hpp) is in a section. A view is the table
// [report] of an experiment file.
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

/// Returns the footnote of a model, or "" if the model has no footnote.
using ModelNote = std::function<std::string(const std::string& model)>;

struct Sources {
  ModelNote note;
  bool several_devices;  ///< true: file names contain the device
  bool several_hosts;    ///< true: file names and subtitles contain the host
  /// Notes of the report; a note is added for each name in a view that is not a column of the table.
  std::vector<std::string>* notes;
};

/// Returns the sections of all cells: one or more for each experiment, device, host and set of changed
/// settings, which the subtitles name.
std::vector<Section> sections_of(const std::vector<Cell>& cells, const Sources& sources);

/// The following functions return the sections of cells with the same experiment, device, host and overrides.
/// `stem` is the start of the sections' file names.

/// For any experiment: a table with one row per case, and a plot of the frame time.
std::vector<Section> case_sections(const std::vector<Cell>& cells, const std::string& stem,
                                   const Sources& sources);
/// For cells with a published frame rate: tables with the layout of the paper's table, one for each variant
/// and value of the axis "reading". Each contains our frame rate, the paper's frame rate and their ratio.
std::vector<Section> paper_sections(const std::vector<Cell>& cells, const std::string& stem,
                                    const Sources& sources);
/// For cells with the metric opengl_ratio (frame time of the OpenGL baseline divided by the frame time of our
/// OpenCL pipeline): a table of these ratios, and their geometric means.
std::vector<Section> ratio_sections(const std::vector<Cell>& cells, const std::string& stem,
                                    const Sources& sources);
/// For cells with the axes dynamics.topology and layers: a table of the frame time and the simulation time of
/// each topology, and a table with one line per topology: its frame time divided by that of the first
/// topology, and the simulation's share of the frame time.
std::vector<Section> topology_sections(const std::vector<Cell>& cells, const std::string& stem,
                                       const Sources& sources);

/// Returns the table that compares our mass-spring solvers with baselines in the rows of topology-solvers
/// that have the status ok and no overrides. Other processes lengthen wall times but hardly change CPU times.
Table solver_table(const std::vector<FoundRow>& rows);

/// Returns the title of the cells' experiment from the rows, or else from shipped_experiment(), or else its
/// name.
std::string title_of(const std::vector<Cell>& cells);

struct CellColumn;

/// Returns a section with title, subtitle and file name, whose table has one line per cell. Its layout has
/// those names of `layout` that are columns, every axis that varies, and the number of triangles beside the
/// model. The table has the footnotes of models, but the section has no plots yet.
Section section_of(const std::vector<Cell>& cells, const std::vector<CellColumn>& columns,
                   const std::string& stem, const Sources& sources, const Layout& layout,
                   std::vector<std::string> remarks);

/// Appends the remarks that are not empty.
void add_remarks(Table& table, const std::vector<std::string>& remarks);

/// Returns those of `names` that are columns of the table.
std::vector<std::string> present(const Table& table, std::vector<std::string> names);

/// Adds the footnotes about models to the table, and marks these models in the row headings. If these do not
/// contain the models, adds the footnotes as remarks instead.
void add_footnotes(Table& table, const ModelNote& note);

/// Returns the view from the rows of the cells, or for rows of earlier versions that of shipped_experiment().
View view_of(const std::vector<Cell>& cells);

}  // namespace pelage
