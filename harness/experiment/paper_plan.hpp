// What `pelage reproduce` shows of a paper (experiments/papers/*.toml): its tables and figures, and what is
// missing. docs/experiments.md describes the files.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace pelage {

/// A picture of a figure: of a case of an experiment, or of an example scene.
struct FigurePanel {
  std::string label;
  std::string experiment, name;      ///< the case; its name without the size of the picture
  std::string scene;                 ///< an example scene instead of a case
  std::string diagram;               ///< kind of `pelage diagram`; "": the picture itself
  std::vector<std::string> options;  ///< further options of `pelage diagram` or `pelage render`
};

struct PaperFigure {
  std::string title, caption;
  std::string differs;  ///< how the figure differs from the paper's, and why
  std::vector<FigurePanel> panels;
};

/// A table of the paper, or of a sentence of it: the tables and plots that a report makes of an experiment.
struct PaperTable {
  std::string title, caption, experiment;
};

/// What cannot be reproduced, and why.
struct MissingPart {
  std::string what, why;
};

struct PaperPlan {
  std::string name;   ///< the word on the command line: the name of the file
  std::string paper;  ///< key of the paper in experiments and claims
  std::string title, authors;
  std::string figures_differ;  ///< how all figures differ from the paper's, and why
  std::vector<PaperTable> tables;
  std::vector<PaperFigure> figures;
  std::vector<MissingPart> missing;
};

/// Returns the plans of all papers, sorted by name. Throws InputError, which names the file, the line and the
/// key, for a file with an error.
std::vector<PaperPlan> paper_plans();

/// Returns the plan with this name. The InputError for an unknown name lists the known ones.
PaperPlan paper_plan(const std::string& name);

/// Returns the names of the experiments of the plan, each once: those of its figures, of its tables, and
/// `more`, those that its claims use, without experiments that are not installed.
std::vector<std::string> experiments_of(const PaperPlan& plan, const std::vector<std::string>& more);

}  // namespace pelage
