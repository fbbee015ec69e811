// Writes the JSON data that the scripts of the HTML report read.

#include <nlohmann/json.hpp>

#include "harness/page/page.hpp"
#include "harness/report/case_table.hpp"

namespace pelage {
namespace {

using Json = nlohmann::ordered_json;

/// Returns a readable name of the cell. No other cell of the same experiment and device has this name.
std::string label_of(const Cell& cell) {
  std::string text = name_of(cell);
  if (!cell.variant.empty()) text += ", " + cell.variant;
  if (!cell.overrides.empty()) text += "; changed: " + changes_of(cell);
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
  std::string escaped;
  escaped.reserve(text.size() + text.size() / 50);
  for (const char c : text) escaped += c == '<' ? std::string_view("\\u003c") : std::string_view(&c, 1);
  return escaped;
}

}  // namespace pelage
