// The sections of a report. A section is a table of the cases of one experiment on one device, with its
// plots. Every cell (harness/report/cells.hpp) is in a section.
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

/// What all sections of a report share.
struct Sources {
  ModelNote note;
  bool several_devices = false,
       several_hosts = false;                 ///< if true, the names of files contain the device, or the host
  std::vector<std::string>* notes = nullptr;  ///< gets a line for each name in a view that is not a column
};

/// Returns the sections of all cells, at least one for each experiment, device and host. Cells that the user
/// changed with --set, --axis or --model are in separate sections, whose subtitles name the changes.
std::vector<Section> sections_of(const std::vector<Cell>& cells, const Sources& sources);

/// Each of the following functions returns the sections of cells of one experiment, device and host, with the
/// same changes by the user. The names of the files begin with `stem`.

/// Any experiment: a row per case, and a plot of the frame time.
std::vector<Section> case_sections(const std::vector<Cell>& cells, const std::string& stem,
                                   const Sources& sources);
/// Cells with a frame rate printed in a paper: one table per reading and variant, with the layout of the
/// papers' tables. It contains our frame rate, the paper's frame rate and their ratio.
std::vector<Section> paper_sections(const std::vector<Cell>& cells, const std::string& stem,
                                    const Sources& sources);
/// Cells with the metric opengl_ratio: the time of the paper's own pipeline (OpenGL) divided by ours, and the
/// geometric means of the ratios.
std::vector<Section> ratio_sections(const std::vector<Cell>& cells, const std::string& stem,
                                    const Sources& sources);
/// Cells with the axes dynamics.topology and layers: the frame time and the simulation time of each topology,
/// and a table with one line per topology, which contains its relative frame time and the share of the
/// simulation.
std::vector<Section> topology_sections(const std::vector<Cell>& cells, const std::string& stem,
                                       const Sources& sources);

/// Returns the experiment of this name that pelage ships; no value if there is none, or if its file cannot be
/// read.
std::optional<Experiment> shipped_experiment(const std::string& name);

/// Returns the title of the cells' experiment: the title in the rows, or else the title of the shipped
/// experiment of this name. Without a title, returns the name.
std::string title_of(const std::vector<Cell>& cells);

/// Marks the models that have a footnote, and adds the footnotes. If the layout does not show the models,
/// adds remarks instead.
void add_footnotes(Table& table, const ModelNote& note);

/// Returns the geometric mean; 0 for an empty list.
double geometric_mean(const std::vector<double>& numbers);

/// Returns the view of the rows. Rows of earlier versions have no view; for such rows, returns the view of
/// the shipped experiment that has the same name as the experiment of the rows.
View view_of(const std::vector<Cell>& cells);

}  // namespace pelage
