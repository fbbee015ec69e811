// Pictures for the HTML report: copies of the timed frames, scaled down and compressed.
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
  int full_width = 0;         ///< width of the timed frame, in pixels
  std::string webp;           ///< the compressed picture (WebP)
};

/// Limits of the size and the quality of the pictures.
struct PictureLimits {
  std::size_t bytes = 6'000'000;  ///< limit of the total size of all pictures
  int most_width = 800, least_width = 160;
  int quality = 80;  ///< quality of the WebP compression, 1 to 100
};

/// Returns the pictures of all cells that are ok and have a picture file. Pictures that are wider than a
/// common width are scaled down to this width. The function reduces this width until all pictures together
/// take at most PictureLimits::bytes. If they do not fit at PictureLimits::least_width, the last pictures are
/// left out. If a picture is left out or cannot be read, a line is added to `notes`.
std::vector<PagePicture> page_pictures(const std::vector<Report>& reports, const PictureLimits& limits,
                                       std::vector<std::string>& notes);

}  // namespace pelage
