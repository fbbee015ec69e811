#include "harness/page/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "harness/atomic_file.hpp"
#include "harness/data_folder.hpp"
#include "harness/error.hpp"
#include "harness/page/parts.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/report/case_table.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

/// pelage's own scripts in the page, in the order in which they run.
constexpr const char* own_scripts[] = {"base.js", "tables.js", "rows.js", "gallery.js"};

/// Returns the text of a script or style of the page, from harness/page/web or an installation's page/.
std::string web_file(const std::string& name) {
  for (const std::filesystem::path& data : data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR))
    for (const char* folder : {"page", "harness/page/web"}) {
      std::ifstream stream(data / folder / name, std::ios::binary);
      if (stream) return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    }
  throw InputError(fmt::format("page/{} is missing; set PELAGE_DATA to pelage's data folder", name));
}

/// Returns 128 random bits as hexadecimal digits, which a script hidden in the results cannot know.
std::string new_nonce() {
  std::random_device random;
  std::string text;
  for (int i = 0; i < 4; ++i) text += fmt::format("{:08x}", std::uint32_t(random()));
  return text;
}

}  // namespace

std::string html_page(const std::string& title, const std::string& body, const std::vector<Report>& reports) {
  const std::string nonce = new_nonce();
  std::string elements;
  for (const char* name : own_scripts)
    elements += fmt::format("<script nonce=\"{}\">{}</script>\n", nonce, web_file(name));

  std::string page = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += fmt::format(
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'nonce-{}'; base-uri 'none'; form-action 'none'\">\n",
      nonce);
  page += fmt::format(
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{}</title>\n<style>\n",
      html_text(title));
  page += web_file("page.css") + "</style>\n</head>\n<body>\n" + body;
  page += "<script type=\"application/json\" id=\"data\">" + data_of(reports) + "</script>\n";
  return page + elements + "</body>\n</html>\n";
}

std::string page_of(const std::vector<Report>& reports, const PageParts& parts) {
  return html_page(page_title(reports), body_of(reports, parts), reports);
}

std::vector<std::string> write_page(const std::vector<Report>& reports, const std::filesystem::path& file) {
  PageParts parts;
  parts.pictures = page_pictures(reports, {}, parts.notes);
  const std::string page = page_of(reports, parts);
  write_text_atomically(file, page);
  return parts.notes;
}

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

namespace {

using Json = nlohmann::ordered_json;

/// Returns a readable name of the cell. No other cell of the same experiment and device has this name.
std::string label_of(const Cell& cell) {
  std::string text = name_of(cell);
  if (!cell.variant.empty()) text += ", " + cell.variant;
  if (!cell.overrides.empty()) text += "; changed: " + changes_of(cell.overrides);
  return text;
}

/// Returns the cells of one report with the indices of their rows. `first` is the index of this report's
/// first row in the page's list of all rows.
Json cells_json(const Report& report, std::size_t first) {
  Json cells = Json::array();
  for (const Cell& cell : report.cells) {
    Json rows = Json::array();
    for (const std::size_t row : cell.rows) rows.push_back(first + row);
    cells.push_back({{"experiment", cell.experiment},
                     {"label", label_of(cell)},
                     {"device", cell.device},
                     {"status", to_text(cell.status)},
                     {"rows", std::move(rows)}});
  }
  return cells;
}

}  // namespace

std::string data_of(const std::vector<Report>& reports) {
  Json parts = Json::array();
  std::size_t rows = 0;
  for (const Report& report : reports) {
    Json files = Json::object();
    for (const auto& [name, file] : report.files) files[name] = file;
    parts.push_back({{"cells", cells_json(report, rows)}, {"files", files}});
    rows += report.rows.size();
  }
  std::string text =
      R"({"parts":)" + parts.dump(-1, ' ', false, Json::error_handler_t::replace) + ",\n\"rows\":[";
  const char* comma = "\n";
  for (const Report& report : reports)
    for (const FoundRow& found : report.rows) {
      text += comma;
      text += to_line(found.row);
      comma = ",\n";
    }
  text += "]}";
  // The page contains this JSON text in a "script" element, where "</script" and "<!--" have a special
  // meaning. So every "<" is escaped. In JSON, "<" occurs only in strings, where the escape \u003c has the
  // same meaning.
  return escaped(text, {{'<', "\\u003c"}});
}

}  // namespace pelage
