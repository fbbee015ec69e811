// Writes the HTML page of a report: one file with its pictures, scripts and data, which needs no network.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/report/report.hpp"

namespace pelage {

/// A compressed picture in the page.
struct PagePicture {
  int report = 0, cell = 0;   ///< index of the report; index of the cell in this report
  int width = 0, height = 0;  ///< size of the picture in the page, in pixels
  std::string webp;           ///< the compressed picture (WebP)
};

/// Limits of the size and the quality of the pictures.
struct PictureLimits {
  std::size_t bytes = 6'000'000;  ///< limit of the total size of all pictures
  int most_width = 800, least_width = 160;
  int quality = 80;  ///< quality of the WebP compression, 1 to 100
};

/// Returns the pictures of all cells that are ok and have a picture file, scaled down to a common width at
/// which all pictures together take at most PictureLimits::bytes. If they do not fit at
/// PictureLimits::least_width, the last pictures are left out. If a picture is left out or cannot be read, a
/// line is added to `notes`.
std::vector<PagePicture> page_pictures(const std::vector<Report>& reports, const PictureLimits& limits,
                                       std::vector<std::string>& notes);

/// Content of the page that is not part of the reports.
struct PageParts {
  std::vector<PagePicture> pictures;
  std::vector<std::string> notes;
};

/// Writes one page with all reports. Returns one line for each missing picture, with the reason. Throws
/// InputError if the file cannot be written.
std::vector<std::string> write_page(const std::vector<Report>& reports, const std::filesystem::path& file);

/// Returns the HTML text of the page. Text from the results is escaped, so it cannot add elements or scripts,
/// and the Content-Security-Policy forbids network access and scripts without the page's random nonce.
std::string page_of(const std::vector<Report>& reports, const PageParts& parts);

/// Returns the title of the only experiment, or the number of experiments.
std::string page_title(const std::vector<Report>& reports);

/// Returns the HTML inside the "body" element, without the scripts.
std::string body_of(const std::vector<Report>& reports, const PageParts& parts);

/// Returns the data of the page's scripts as JSON without "<": the cells and the files (name -> text) of each
/// report, and all rows, unchanged from the result files.
std::string data_of(const std::vector<Report>& reports);

}  // namespace pelage
