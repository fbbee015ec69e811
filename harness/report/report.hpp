// Writes the files of a report: tables, plots, pictures, bibliography and provenance. harness/page writes the
// HTML page.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/claims/judge.hpp"
#include "harness/record/all_results.hpp"
#include "harness/report/sections.hpp"
#include "harness/report/springs.hpp"

namespace pelage {

struct ReportPlot {
  std::string title,
      stem;  ///< the files are plots/<stem>.svg, .pdf, .csv, .py and (for sections) .json
};

struct ReportPicture {
  std::string title, file;  ///< the picture file is images/<file> in the report's folder
};

struct Report {
  std::filesystem::path folder;  ///< folder that contains the files of the report
  std::vector<FoundRow> rows;    ///< all rows of the report; Cell::rows are indices of this list
  std::vector<Cell> cells;
  std::vector<Section> sections;  ///< each section's table is also in tables/STEM.csv, .tex and .txt
  /// Lines of tables/topology-solvers-ratios.csv. If there are no lines, there is no such file.
  std::vector<SolverLine> solvers;
  /// Verdicts on the papers' claims about the experiments in the rows. They are also in tables/claims.csv,
  /// unless this list is empty.
  std::vector<claims::Judged> claims;
  std::vector<ReportPlot> plots;
  std::vector<ReportPicture> pictures;
  /// Text about the cost of additional layers, and the text of the fit by plots/scaling.py.
  std::string scaling;
  std::vector<std::string> notes;  ///< warnings, and missing parts of the report with the reasons
};

/// Writes one report per set of rows (input_sets()): the report of the first set into `folder`, the other
/// reports into the folders inputs-2, inputs-3 and so on in `folder`. The section "Left out" of the first
/// report also contains `left_out`. Returns the reports in this order. Throws like write_report().
std::vector<Report> write_reports(const std::vector<FoundRow>& rows, const std::filesystem::path& folder,
                                  const ModelNote& note, const std::vector<LeftOut>& left_out = {});

/// Writes all parts of the report into `folder` (created if missing) and returns the report. `notes` become
/// the first notes of the report. If `left_out` or the result of without_numbers() is not empty, the last
/// section of the report lists both. Throws InputError for a path that cannot be written.
Report write_report(const std::vector<FoundRow>& rows, const std::filesystem::path& folder,
                    const ModelNote& note, std::vector<std::string> notes = {},
                    std::vector<LeftOut> left_out = {});

/// Returns BibTeX entries of pelage and of the papers whose experiments are among the rows.
std::string bibliography_of(const std::vector<FoundRow>& rows);

/// Returns the provenance of the rows as text, one block per run and journal. If a field differs between
/// rows, all its values are listed.
std::string provenance_of(const std::vector<FoundRow>& rows);

}  // namespace pelage
