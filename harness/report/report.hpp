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
  std::vector<SolverLine> solvers;     ///< tables/topology-solvers.csv if not empty
  std::vector<Claim> claims;           ///< tables/claims.csv if not empty
  std::vector<ReportPlot> plots;
  std::vector<ReportPicture> pictures;
  std::string scaling;             ///< cost of doubling the layers; tables/scaling.txt also contains the fit
  std::vector<std::string> notes;  ///< missing parts and the reasons
};

/// Fills in the titles from the shipped experiment files; does not search for files of the user.
void add_titles(std::vector<PaperTable>& tables);

/// Writes all parts into `folder` (created if missing) and returns them. Throws InputError for a path that
/// cannot be written.
Report write_report(const std::vector<FoundRow>& rows, const std::filesystem::path& folder,
                    const ModelNote& note);

/// Returns the page, without any resource from outside the folder.
std::string html_of(const Report& report, const std::filesystem::path& folder);

/// Returns BibTeX entries of pelage and of the papers whose experiments are among the rows.
std::string bibliography_of(const std::vector<FoundRow>& rows);

/// Returns the provenance: one block per run and device; fields that differ are listed with all their values.
std::string provenance_of(const std::vector<FoundRow>& rows);

}  // namespace pelage
