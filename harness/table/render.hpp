// The formats of a table: text for a terminal, CSV, LaTeX and HTML.
#pragma once
#include <string>
#include <vector>

#include "harness/table/table.hpp"

namespace pelage {

/// Returns the cross table as text for a terminal, with the title above the table and the remarks and
/// footnotes below it.
std::string text_of(const Table& table);
/// Returns CSV (RFC 4180, but lines end with a line feed only): a line with the names of the columns, then
/// all values of each line.
std::string csv_of(const Table& table);
/// Returns the cross table in LaTeX, for use with \input. It needs the packages booktabs and threeparttable.
std::string latex_of(const Table& table);
/// Returns the cross table as HTML, with its remarks and footnotes below it, but without the title.
std::string html_of(const Table& table);

/// Returns one line of CSV, including its line feed. Fields that contain a comma, a quote or a line break are
/// quoted. If a spreadsheet could read a text as a formula, an apostrophe precedes the text.
std::string csv_line(const std::vector<std::string>& fields);
/// Returns the text with LaTeX's special characters escaped.
std::string latex_text(const std::string& text);
/// Returns the text with HTML's special characters escaped.
std::string html_text(const std::string& text);

}  // namespace pelage
