// Writes the HTML page of a report. The page is one file that contains its pictures, scripts and data, so it
// needs no network.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/page/pictures.hpp"
#include "harness/report/report.hpp"

namespace pelage {

/// Content of the page that is not part of the reports.
struct PageParts {
  std::vector<PagePicture> pictures;
  std::vector<std::string> notes;
};

/// Writes one page with all reports. Returns one line of text for each missing picture, with the
/// reason. Throws InputError if the file cannot be written.
std::vector<std::string> write_page(const std::vector<Report>& reports, const std::filesystem::path& file);

/// Returns the HTML text of the page. Text from the results is escaped, so it cannot add elements or scripts.
/// In addition, the page's Content-Security-Policy forbids network access, and permits only scripts
/// whose attribute `nonce` is the page's random number.
std::string page_of(const std::vector<Report>& reports, const PageParts& parts);

/// Returns the HTML inside the "body" element, without the scripts.
std::string body_of(const std::vector<Report>& reports, const PageParts& parts);

/// Returns the data that the page's scripts read, as JSON. The data contain the cells and the files
/// (name -> text) of each report, and all rows, unchanged from the result files. The text contains no
/// "<".
std::string data_of(const std::vector<Report>& reports);

}  // namespace pelage
