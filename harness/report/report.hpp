// Writes the files of a report: tables, plots, pictures, bibliography and provenance. harness/page writes the
// HTML page.
#pragma once
#include <filesystem>
#include <functional>
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
  /// Verdicts on the papers' claims about the experiments in the rows, also in tables/claims.csv if there are
  /// any.
  std::vector<claims::Judged> claims;
  std::vector<ReportPlot> plots;
  /// Text about the cost of additional layers, and the text of the fit by plots/scaling.py.
  std::string scaling;
  std::vector<std::string> notes;  ///< warnings, and missing parts of the report with the reasons
  /// Names and texts of the files that readers can save from the page.
  std::vector<std::pair<std::string, std::string>> files;
};

/// Writes one report per set of rows (input_sets()): the first into `folder`, the others into its folders
/// inputs-2, inputs-3 and so on. The section "Left out" of the first report also contains `left_out`. Throws
/// like write_report().
std::vector<Report> write_reports(const std::vector<FoundRow>& rows, const std::filesystem::path& folder,
                                  const ModelNote& note, const std::vector<LeftOut>& left_out = {});

/// Writes all parts of the report into `folder` (created if missing). `notes` become the first notes of the
/// report. If `left_out` or the result of without_numbers() is not empty, the last section lists both. Throws
/// InputError for a path that cannot be written.
Report write_report(const std::vector<FoundRow>& rows, const std::filesystem::path& folder,
                    const ModelNote& note, std::vector<std::string> notes = {},
                    std::vector<LeftOut> left_out = {});

/// Returns BibTeX entries of pelage and of the papers whose experiments are among the rows.
std::string bibliography_of(const std::vector<FoundRow>& rows);

/// Returns the provenance of the rows as text, one block per run and journal. If a field differs between
/// rows, all its values are listed.
std::string provenance_of(const std::vector<FoundRow>& rows);

}  // namespace pelage
