// Writes tables as CSV (comma-separated values).
#include "harness/base/numbers.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

/// Whether a spreadsheet could take the text for a formula: it begins with =, +, -, @, a tab or a carriage
/// return, and is not a number.
bool is_formula(const std::string& text) {
  if (text.empty() || std::string_view("=+-@\t\r").find(text.front()) == std::string_view::npos) return false;
  return !double_of(std::string_view(text).substr(text.front() == '+' ? 1 : 0));
}

}  // namespace

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& given : fields) {
    if (&given != &fields.front()) line += ',';
    const std::string field = is_formula(given) ? "'" + given : given;
    const bool plain = field.find_first_of(",\"\r\n") == std::string::npos;
    line += plain ? field : '"' + escaped(field, {{'"', "\"\""}}) + '"';
  }
  return line + "\n";
}

std::string csv_lines(const std::vector<std::vector<std::string>>& lines) {
  std::string text;
  for (const std::vector<std::string>& line : lines) text += csv_line(line);
  return text;
}

std::string csv_of(const Table& table) {
  std::vector<std::vector<std::string>> lines(1);
  for (const Column& column : table.columns) lines[0].push_back(column.name);
  for (const auto& line : table.lines) {
    lines.emplace_back();
    for (const Value& value : line) lines.back().push_back(value.data);
  }
  return csv_lines(lines);
}

}  // namespace pelage
