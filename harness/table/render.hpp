// Arranges a table as a cross table, and writes it as text for a terminal, as CSV, as LaTeX and as HTML.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
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
/// Returns the text with each character that has an entry in `escapes` replaced by this entry.
std::string escaped(const std::string& text, const std::map<char, std::string_view>& escapes);
/// Returns the text with LaTeX's special characters escaped.
std::string latex_text(const std::string& text);
/// Returns the text with HTML's special characters escaped.
std::string html_text(const std::string& text);

struct Pivot {
  struct Row {
    std::vector<Value> keys;                  ///< one value for each column in Pivot::keys
    std::vector<std::optional<Value>> cells;  ///< for each group, one cell for each column in Pivot::values;
                                              ///< std::nullopt if no line belongs in the cell
  };
  struct Block {
    std::vector<std::string> label;  ///< heading: one text per column of Layout::blocks, such as "16 layers"
    std::vector<Row> rows;
  };
  std::vector<Column> keys;  ///< columns of Layout::rows; if there are none, one column without a heading
  std::vector<Column> values;
  std::vector<std::vector<std::string>>
      groups;  ///< headings of the groups; one group without a heading if Layout::groups is empty
  std::vector<Block> blocks;  ///< one block without a heading if Layout::blocks is empty
  bool grouped() const { return groups.size() != 1 || !groups[0].empty(); }
};

/// If two lines belong in the same cells, the second line gets a separate row.
Pivot pivot_of(const Table& table);

/// Joins the parts with ", ".
std::string joined(const std::vector<std::string>& parts);

}  // namespace pelage
