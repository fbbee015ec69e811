// The pictures of the page: reduced copies of the timed frames.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/report/report.hpp"

namespace pelage {

/// A picture of the page.
struct PagePicture {
  int report = 0, cell = 0;   ///< index of the report, and of the cell in it
  int width = 0, height = 0;  ///< of the picture in the page, in pixels
  int full_width = 0;         ///< of the timed frame
  std::string webp;           ///< bytes of the file
};

/// Limits of the pictures.
struct PictureLimits {
  std::size_t bytes = 6'000'000;  ///< of all pictures together
  int most_width = 800, least_width = 160;
  int quality = 80;  ///< of WebP, 1 to 100
};

/// Returns the pictures of all cells that are ok and have a picture file. All pictures have at most the same
/// width, which is reduced until all of them together are within the limit. Pictures that do not fit at the
/// least width are left out. `notes` gets a line if a picture is left out or cannot be read.
std::vector<PagePicture> page_pictures(const std::vector<Report>& reports, const PictureLimits& limits,
                                       std::vector<std::string>& notes);

}  // namespace pelage
