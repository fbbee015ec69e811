// Writes a table as text for a terminal, as CSV, as LaTeX and as HTML.
#pragma once
#include <string>
#include <vector>

#include "harness/table/table.hpp"

namespace pelage {

/// Returns the cross table as text for a terminal. The title is above the table, and the remarks and
/// footnotes are below it.
std::string text_of(const Table& table);
/// Returns the table as CSV (RFC 4180, but lines end with a line feed only). The first line contains the
/// names of the columns. Each further line contains all values of one line of the table.
std::string csv_of(const Table& table);
/// Returns the cross table as LaTeX text, which a document can include with \input. The document needs the
/// packages booktabs and threeparttable.
std::string latex_of(const Table& table);
/// Returns the cross table as HTML. The remarks and footnotes are below the table. The title is not included.
std::string html_of(const Table& table);

/// Returns one line of CSV, including its line feed. Fields that contain a comma, a quote or a line break are
/// quoted. If a spreadsheet could read a field as a formula, the function puts an apostrophe before the
/// field.
std::string csv_line(const std::vector<std::string>& fields);
/// Returns the text with LaTeX's special characters escaped.
std::string latex_text(const std::string& text);
/// Returns the text with HTML's special characters escaped.
std::string html_text(const std::string& text);

}  // namespace pelage
