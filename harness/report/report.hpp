// Writes the files of a report: tables, plots, pictures, bibliography and provenance. harness/page writes the
// HTML page.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/claims/judge.hpp"
#include "harness/report/sections.hpp"

namespace pelage {

struct ReportPlot {
  std::string title,
      stem;  ///< the files are plots/<stem>.svg, .pdf, .csv, .py and (for sections) .json
};

struct Report {
  std::filesystem::path folder;  ///< folder that contains the files of the report
  std::vector<FoundRow> rows;    ///< all rows of the report; Cell::rows are indices of this list
  std::vector<Cell> cells;
  std::vector<Section> sections;  ///< each section's table is also in tables/STEM.csv, .tex and .txt
  /// Table of tables/topology-solvers-ratios.csv; without lines, there is no such file.
  Table solvers;
  /// Verdicts on the claims about the experiments in the rows, also in tables/claims.csv if there are any.
  std::vector<claims::Judged> claims;
  std::string claims_file;  ///< name of the user's file of claims; "" for experiments/claims.toml
  std::vector<ReportPlot> plots;
  /// Text about the cost of additional layers, and the text of the fit by plots/scaling.py.
  std::string scaling;
  std::vector<std::string> notes;  ///< warnings, and missing parts of the report with the reasons
  /// Names and texts of the files that readers can save from the page.
  std::vector<std::pair<std::string, std::string>> files;
};

/// Writes one report per set of rows (input_sets()): the first into `folder`, the others into its folders
/// inputs-2, inputs-3 and so on. The section "Left out" of the first report also contains `left_out`. Judges
/// `claims`, or those of experiments/claims.toml. Throws like write_report().
std::vector<Report> write_reports(const std::vector<FoundRow>& rows, const std::filesystem::path& folder,
                                  const ModelNote& note, const std::vector<LeftOut>& left_out = {},
                                  const std::optional<claims::ClaimFile>& claims = {});

/// Writes all parts of the report into `folder` (created if missing). `notes` become the first notes of the
/// report. If `left_out` or the result of without_numbers() is not empty, the last section lists both. Throws
/// InputError for a path that cannot be written.
Report write_report(const std::vector<FoundRow>& rows, const std::filesystem::path& folder,
                    const ModelNote& note, std::vector<std::string> notes = {},
                    std::vector<LeftOut> left_out = {}, const std::optional<claims::ClaimFile>& claims = {});

/// Returns BibTeX entries of pelage and of the papers whose experiments are among the rows.
std::string bibliography_of(const std::vector<FoundRow>& rows);

/// Returns the provenance of the rows as text, one block per run and journal. If a field differs between
/// rows, all its values are listed.
std::string provenance_of(const std::vector<FoundRow>& rows);

// What the other tables of a report leave out: every case is either in a table with its time, or here with
// the reason.

/// Returns one entry for each run or shard in which some cases have no row. It states only their number,
/// because the rows do not contain the names of the other cases of their run. `rows` were read from
/// `journals`.
std::vector<LeftOut> missing_cases(const std::vector<std::filesystem::path>& journals,
                                   const std::vector<FoundRow>& rows);

/// Returns one entry for each cell without a time, for each cell without a ratio to the OpenGL baseline if
/// others of its experiment and variant have one, and for each row whose implausible event times were left
/// out.
std::vector<LeftOut> without_numbers(const std::vector<Cell>& cells, const std::vector<FoundRow>& rows);

/// Returns the section "Left out" with this list, which must not be empty.
Section left_out_section(const std::vector<LeftOut>& list);

// Experiments that vary the numbers of layers, pixels and triangles: time ratios of cases that differ only in
// their number of layers, and memory. plots/scaling.py fits a model of the frame time to scaling_csv().

/// Returns the cells of all experiments whose file sets report.program = "scaling", without cells that lack a
/// time, a triangle count, a number of layers or a picture size. If some cells were changed on the command
/// line, returns only the largest group of cells with equal changes.
std::vector<Cell> scaling_cells(const std::vector<Cell>& cells);

/// Returns CSV with one line per cell, the input of plots/scaling.py.
std::string scaling_csv(const std::vector<Cell>& cells);

/// Returns text for a terminal: the time ratios, and the largest peak memory of all cases.
std::string scaling_text(const std::vector<Cell>& cells);

/// Returns the cells with status ok that have the metrics frame_over_half and frame_over_quarter
/// (harness/subjects/in_turns.hpp).
std::vector<Cell> in_turns_cells(const std::vector<Cell>& cells);

/// Returns CSV with the two metrics of each cell and their 95% intervals. `cells` is a result of
/// in_turns_cells().
std::string in_turns_csv(const std::vector<Cell>& cells);

/// Returns the ratios of in_turns_csv() as text for a terminal, followed by the largest ratios.
std::string in_turns_text(const std::vector<Cell>& cells);

}  // namespace pelage
