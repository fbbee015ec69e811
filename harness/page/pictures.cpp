#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/page/page.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/report/case_table.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// A picture file, and the indices of its report and cell.
struct Source {
  int report, cell;
  fs::path file;
};

std::vector<Source> sources_of(const std::vector<Report>& reports) {
  std::vector<Source> sources;
  for (std::size_t r = 0; r < reports.size(); ++r)
    for (const Cell& cell : reports[r].cells)
      if (cell.status == Status::ok && fs::is_regular_file(cell.image))
        sources.push_back({int(r), cell.index, cell.image});
  // The rows of a run are in a random order. Sorts the pictures by experiment and by the names of their
  // cells, so that pictures of the same model are neighbours.
  std::stable_sort(sources.begin(), sources.end(), [&](const Source& a, const Source& b) {
    if (a.report != b.report) return a.report < b.report;
    const std::vector<Cell>& cells = reports[std::size_t(a.report)].cells;
    const Cell &left = cells[std::size_t(a.cell)], &right = cells[std::size_t(b.cell)];
    if (left.experiment != right.experiment) return left.experiment < right.experiment;
    return natural_less(name_of(left), name_of(right));
  });
  return sources;
}

/// Reads the pictures, scales them down to at most `width` pixels and compresses them. If a picture cannot be
/// read, removes it from `sources` and adds a note.
std::vector<PagePicture> pictures_of(std::vector<Source>& sources, int width, int quality,
                                     std::vector<std::string>& notes) {
  std::vector<PagePicture> pictures;
  std::erase_if(sources, [&](const Source& source) {
    try {
      const Picture small = reduced(read_picture(source.file), width);
      pictures.push_back({source.report, source.cell, small.width, small.height, webp_of(small, quality)});
      return false;
    } catch (const InputError& error) {
      notes.push_back(fmt::format("a picture is missing from the page: {}", error.what()));
      return true;
    }
  });
  return pictures;
}

std::size_t bytes_of(const std::vector<PagePicture>& pictures) {
  std::size_t bytes = 0;
  for (const PagePicture& picture : pictures) bytes += picture.webp.size();
  return bytes;
}

}  // namespace

std::vector<PagePicture> page_pictures(const std::vector<Report>& reports, const PictureLimits& limits,
                                       std::vector<std::string>& notes) {
  std::vector<Source> sources = sources_of(reports);
  // The first guess of the width assumes that a compressed picture takes 0.1 bytes per pixel and that its
  // height is 0.7 times its width.
  const double guess =
      std::sqrt(double(limits.bytes) / (0.07 * double(std::max<std::size_t>(1, sources.size()))));
  int width = int(std::clamp(guess, double(limits.least_width), double(limits.most_width)));
  std::vector<PagePicture> pictures = pictures_of(sources, width, limits.quality, notes);
  for (std::size_t bytes = bytes_of(pictures); bytes > limits.bytes && width > limits.least_width;
       bytes = bytes_of(pictures)) {
    width = std::max(limits.least_width, int(0.95 * width * std::sqrt(double(limits.bytes) / double(bytes))));
    pictures = pictures_of(sources, width, limits.quality, notes);
  }
  const std::size_t all = pictures.size();
  while (bytes_of(pictures) > limits.bytes) pictures.pop_back();
  if (pictures.size() < all)
    notes.push_back(fmt::format(
        "the page shows {} of {} pictures, because its pictures may take at most {} bytes in total",
        pictures.size(), all, limits.bytes));
  return pictures;
}

}  // namespace pelage
