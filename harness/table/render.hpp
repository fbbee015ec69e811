// Writes a table as text for a terminal, as CSV, as LaTeX and as HTML.
#pragma once
#include <string>
#include <vector>

#include "harness/table/table.hpp"

namespace pelage {

/// Returns the cross table as text for a terminal, below the title and above the remarks and footnotes.
std::string text_of(const Table& table);
/// Returns the table as CSV (RFC 4180, but lines end with a line feed only), with the names of the columns.
std::string csv_of(const Table& table);
/// Returns the cross table for \input in a LaTeX document with the packages booktabs and threeparttable.
std::string latex_of(const Table& table);
/// Returns the cross table as HTML, without the title.
std::string html_of(const Table& table);

/// Returns one line of CSV, including its line feed. Fields that contain a comma, a quote or a line break are
/// quoted. A field that a spreadsheet could read as a formula gets an apostrophe.
std::string csv_line(const std::vector<std::string>& fields);
std::string csv_lines(const std::vector<std::vector<std::string>>& lines);
/// Returns the text with LaTeX's special characters escaped.
std::string latex_text(const std::string& text);
/// Returns the text with HTML's special characters escaped.
std::string html_text(const std::string& text);

}  // namespace pelage
