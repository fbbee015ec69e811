// A table of a report: named columns and one line per measurement. CSV files contain all of it; in text,
// LaTeX and HTML (render.hpp), readers see the lines as a cross table, which the layout determines.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pelage {

/// The value of one column in a line of the table.
struct Value {
  std::string data;       ///< text in CSV: a number with six significant digits, or a word; "" if missing
  std::string shown;      ///< text in the cross table that readers see
  std::string hint = {};  ///< tooltip of the value in an HTML page
  std::string mark = {};  ///< mark of a footnote: "a"
  bool failed = false;    ///< true if `shown` is the status of a case or "-", because the number is missing
  int cell = -1;  ///< Cell::index (harness/report/cells.hpp) of the cell with this value; -1 if there is none
};

Value text_value(const std::string& text);
/// `data` has six significant digits, and `shown` three_digits(). Without a number they are "" and "-".
Value number_value(std::optional<double> number);
/// The same for a number rounded to a whole number.
Value count_value(std::optional<double> number);

/// Returns the number with three significant digits and at most four decimals: "0.842", "12.3", "267".
/// Numbers of 1000 or more keep all digits before the point. Numbers below 0.0001 have an exponent.
std::string three_digits(double number);

struct Column {
  std::string name;     ///< heading in CSV, for example "median_ms"
  std::string heading;  ///< heading in the cross table, for example "frame, ms"
  /// Format of the values in headings of blocks and groups: "{} layers" shows the value 16 as "16 layers".
  std::string label = "{}";
  /// Values in the order of their blocks or groups; others come last, sorted by natural_less().
  std::vector<std::string> order = {};
};

/// The layout of the cross table: names of columns. Each combination of values of `blocks` has its own block
/// (a separate table), each of `rows` a row in it, and each of `groups` a group of columns, with one column
/// for each name in `values`.
struct Layout {
  std::vector<std::string> blocks, rows, groups, values;
};

struct Table {
  std::string title;        ///< for example "Cost of each topology"
  std::string subtitle;     ///< experiment, device, and values that all lines have in common
  std::string answer = {};  ///< one sentence with the result; shown above the lines, but not in LaTeX
  std::string stem;         ///< STEM of the files tables/STEM.csv and tables/STEM.tex
  std::vector<Column> columns;
  std::vector<std::vector<Value>>
      lines;  ///< one value per column; the cross table's rows keep the order of the lines
  Layout layout;
  std::vector<std::string> remarks;  ///< sentences below the table
  /// Marks and texts: "a" and "hippo: a stand-in ...".
  std::vector<std::pair<std::string, std::string>> footnotes;
};

/// Returns the index of the column, or -1 if there is no such column.
int column_of(const Table& table, std::string_view name);

/// Numbers are sorted by value, picture sizes ("800x600") by their number of pixels, both before other texts.
/// Numbers inside other texts are also sorted by value: "k2" precedes "k10".
bool natural_less(const std::string& a, const std::string& b);

/// Returns Column::label with "{}" replaced by the value.
std::string with_value(const Column& column, const std::string& value);

/// Whether `a` precedes `b` in Column::order. Values that are not in this list are compared by
/// natural_less().
bool precedes(const Column& column, const std::string& a, const std::string& b);

}  // namespace pelage
