// Makes the sections of a report. A section is a table with the results of one experiment on one device, and
// its plots. Every cell (harness/report/cells.hpp) is in a section.
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
  bool several_devices = false,
       several_hosts = false;  ///< if true, file names contain the device or the host
  std::vector<std::string>* notes =
      nullptr;  ///< notes of the report; names in a view that are no columns are added
};

/// Returns the sections of all cells: one or more for each experiment, device and host. Cells whose settings
/// the user changed with --set, --axis or --model have separate sections. The subtitles of these sections
/// name the changes.
std::vector<Section> sections_of(const std::vector<Cell>& cells, const Sources& sources);

/// The following functions return the sections of one group of cells. All cells of the group have the same
/// experiment, device, host and settings changed by the user. `stem` is the start of the sections' file
/// names.

/// For any experiment: a table with one row per case, and a plot of the frame time.
std::vector<Section> case_sections(const std::vector<Cell>& cells, const std::string& stem,
                                   const Sources& sources);
/// For cells with a frame rate that a paper published: one table per reading and variant, with the layout of
/// the paper's table. It contains our frame rate, the paper's frame rate and their ratio.
std::vector<Section> paper_sections(const std::vector<Cell>& cells, const std::string& stem,
                                    const Sources& sources);
/// For cells with the metric opengl_ratio, which is the frame time of the paper's pipeline (OpenGL) divided
/// by the frame time of ours: a table of these ratios, and their geometric means.
std::vector<Section> ratio_sections(const std::vector<Cell>& cells, const std::string& stem,
                                    const Sources& sources);
/// For cells with the axes dynamics.topology and layers: a table of the frame time and the simulation time of
/// each topology. A second table has one line per topology, with its relative frame time and the simulation's
/// share of the frame time.
std::vector<Section> topology_sections(const std::vector<Cell>& cells, const std::string& stem,
                                       const Sources& sources);

/// Returns the experiment with this name from pelage's experiment files. Returns nothing if there is no such
/// file, or if it cannot be read.
std::optional<Experiment> shipped_experiment(const std::string& name);

/// Returns the title of the cells' experiment. The title is from the rows, or else from the experiment file
/// that shipped_experiment() reads. If there is no title, returns the name of the experiment.
std::string title_of(const std::vector<Cell>& cells);

/// Adds the footnotes about models, and marks the models in the table. If the table has no row headings with
/// models, adds the texts as remarks instead.
void add_footnotes(Table& table, const ModelNote& note);

/// Returns the geometric mean; 0 for an empty list.
double geometric_mean(const std::vector<double>& numbers);

/// Returns the view (the table [report] of the experiment file) from the rows of the cells. Rows of earlier
/// versions do not contain it. For such rows, returns the view of the experiment that shipped_experiment()
/// reads.
View view_of(const std::vector<Cell>& cells);

}  // namespace pelage
