// The report: tables, plots, pictures, bibliography, provenance and a page that shows them.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/report/claims.hpp"
#include "harness/report/paper_table.hpp"
#include "harness/report/rival_table.hpp"
#include "harness/report/springs.hpp"
#include "harness/report/topology_table.hpp"
#include "harness/report/way_table.hpp"

namespace pelage {

struct ReportPlot {
  std::string title, stem;  ///< plots/STEM.svg, .pdf, .csv, .py
};

struct ReportPicture {
  std::string title, file;  ///< images/FILE
};

struct Report {
  std::vector<Cell> cells;
  std::vector<PaperTable> tables;
  std::vector<std::string> table_stems;  ///< tables/STEM.csv, .tex, one per table
  std::vector<TopologyTable> topologies;
  std::vector<std::string> topology_stems;  ///< tables/STEM.csv, .tex, one per such table
  std::vector<RivalTable> rivals;
  std::vector<std::string> rival_stems;  ///< tables/STEM.csv, one per such table
  std::vector<WayTable> ways;
  std::vector<std::string> way_stems;  ///< tables/STEM.csv, one per such table
  std::vector<SolverLine> solvers;     ///< tables/topology-solvers.csv where there are any
  std::vector<Claim> claims;           ///< tables/claims.csv where there are any
  std::vector<ReportPlot> plots;
  std::vector<ReportPicture> pictures;
  std::string scaling;             ///< what doubling the layers costs; tables/scaling.txt has the fit as well
  std::vector<std::string> notes;  ///< what is missing and why
};

/// Fills in what the experiment's own file says of it; a file of the user's is not looked for.
void add_titles(std::vector<PaperTable>& tables);

/// Writes everything into `folder` (made when missing) and returns what it holds. Throws InputError for a
/// place that cannot be written.
Report write_report(const std::vector<FoundRow>& rows, const std::filesystem::path& folder,
                    const ModelNote& note);

/// The page, without any resource from outside the folder.
std::string html_of(const Report& report, const std::filesystem::path& folder);

/// BibTeX of pelage and of the papers whose experiments are among the rows.
std::string bibliography_of(const std::vector<FoundRow>& rows);

/// Who ran what, where and when: one block per run and device, differing fields listed with all their values.
std::string provenance_of(const std::vector<FoundRow>& rows);

}  // namespace pelage
