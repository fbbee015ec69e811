// A table of a report, independent of its file format. A table has named columns and one line per
// measurement. Its layout determines which columns readers see, and where. The renderers for text, LaTeX and
// HTML (render.hpp) show the lines as a cross table. CSV has all columns and one line per measurement.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

/// One value of a line.
struct Value {
  std::string data;   ///< in CSV: a number with six significant digits, or a text; "" if there is no value
  std::string shown;  ///< for readers
  std::string hint = {};  ///< a longer text, which an HTML page shows when the pointer is on the value
  std::string mark = {};  ///< mark of a footnote: "a"
  bool failed = false;    ///< true if `shown` is a status that replaces a missing number
  int cell = -1;  ///< index of the report's cell (harness/report/cells.hpp) that has the value; -1 if none
};

Value text_value(const std::string& text);
/// A number: six significant digits in CSV, three for readers. Without a number, the text in CSV is "" and
/// readers see "-".
Value number_value(std::optional<double> number);
/// A number rounded to a whole number. Without a number, the text in CSV is "" and readers see "-".
Value count_value(std::optional<double> number);

/// Returns the number with three significant digits and at most four decimals: "0.842", "12.3", "267".
/// Numbers from 1000 keep all digits before the decimal point. Numbers below 0.0001 have an exponent.
std::string three_digits(double number);

struct Column {
  std::string name;     ///< heading in CSV: "median_ms"
  std::string heading;  ///< heading for readers: "frame, ms"
  /// Text of a value in the heading of a block or of a group of columns. "{}" stands for the value, for
  /// instance in "{} layers".
  std::string label = "{}";
  /// Order of the column's values in blocks and groups. Values that are not in this list follow in the order
  /// of natural_less().
  std::vector<std::string> order = {};
};

/// Names of columns. Readers see one table per combination of the values of `blocks`. In it, each combination
/// of the values of `rows` has a row, each combination of the values of `groups` has a group of columns, and
/// a group has one column for each of `values`.
struct Layout {
  std::vector<std::string> blocks, rows, groups, values;
};

struct Table {
  std::string title;     ///< for instance "Cost of each topology"
  std::string subtitle;  ///< where the lines come from: experiment, device, values that all lines share
  std::string stem;      ///< name of the files tables/STEM.csv and tables/STEM.tex
  std::vector<Column> columns;
  std::vector<std::vector<Value>> lines;  ///< each has one value per column; rows keep the order of the lines
  Layout layout;
  std::vector<std::string> remarks;    ///< sentences below the table
  std::vector<std::string> footnotes;  ///< "a hippo: a stand-in ...": the mark, a space, the text
};

/// Returns the index of the column, or -1 if there is no such column.
int column_of(const Table& table, std::string_view name);

/// Orders numbers by value, picture sizes ("800x600") by their number of pixels, and other texts so that
/// numbers in them are ordered by value: "k2" precedes "k10". Numbers and sizes precede other texts.
bool natural_less(const std::string& a, const std::string& b);

/// Returns the text of the value in a heading: Column::label with the value in place of "{}".
std::string with_value(const Column& column, const std::string& value);

/// Returns whether value a of the column precedes value b: by Column::order, else by natural_less().
bool precedes(const Column& column, const std::string& a, const std::string& b);

/// Returns the number that the text contains: a decimal number, or the number of pixels of a picture size
/// such as "800x600". Returns no number for other texts.
std::optional<double> number_of(const std::string& text);

}  // namespace pelage
