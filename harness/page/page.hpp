// The page of a report: one HTML file that contains everything it shows, and needs no network.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/page/chart.hpp"
#include "harness/page/libraries.hpp"
#include "harness/page/pictures.hpp"
#include "harness/report/report.hpp"

namespace pelage {

/// What the page contains in addition to the reports.
struct PageParts {
  std::vector<PagePicture> pictures;
  std::optional<Library> charts;  ///< Chart.js; without it the page shows the plots as static pictures
  std::vector<std::string> notes;
};

/// Writes the page of all reports. Returns one line for each part that is missing, with the reason. Throws
/// InputError if the file cannot be written.
std::vector<std::string> write_page(const std::vector<Report>& reports, const std::filesystem::path& file);

/// Returns the page as text. Texts of the results cannot add elements or scripts: they are escaped, and the
/// page's Content-Security-Policy permits no network access and only scripts with a random number that
/// the page contains (its nonce).
std::string page_of(const std::vector<Report>& reports, const PageParts& parts);

/// Returns the page's element "body" without its scripts.
std::string body_of(const std::vector<Report>& reports, const PageParts& parts);

/// Returns the data of the scripts as JSON in which no "<" occurs: for each report its cells, charts and
/// files (name -> text), and all rows as they are in the journals.
std::string data_of(const std::vector<Report>& reports);

/// A chart and its place in the page.
struct PlacedChart {
  int section = -1;  ///< index of the section of the report; -1 if the chart belongs to no section
  Chart chart;
};

/// Returns the charts of the report: of its sections, of the mass-spring studies, and of the experiment
/// scaling.
std::vector<PlacedChart> charts_of(const Report& report);

}  // namespace pelage
