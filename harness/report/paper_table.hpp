// A table of our numbers beside the numbers of a paper's table. It has one block of rows per number of
// layers. Each block has one row per model, and three columns per picture size.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/report/cells.hpp"

namespace pelage {

struct PaperTable {
  struct Row {
    std::string model;
    std::string triangles;                   ///< "9360"
    std::string note;                        ///< footnote mark, "a", "b" ...; "" without a footnote
    std::vector<std::optional<Cell>> cells;  ///< per size
  };
  struct Block {
    std::string layers;
    std::vector<Row> rows;
  };
  std::string experiment, variant, device, host, reading;
  std::string title, source, hardware;  ///< caption; name of the paper's table; hardware of the paper
  std::vector<std::string> sizes;
  std::vector<Block> blocks;
  std::vector<std::string> footnotes;  ///< "a: stand-in ..."
};

/// What a table shows for one cell: our frames per second (or the status), the paper's frames per second, and
/// the ratio of our number to the paper's number. A missing number is "-".
struct CellText {
  std::string ours, paper, ratio;
};
CellText cell_text(const Cell& cell);

/// A function that returns the footnote of a model, or "" if the model has no footnote.
using ModelNote = std::function<std::string(const std::string& model)>;

/// Returns one table for each combination of experiment, device, host, variant and reading (a set of scene
/// settings, such as an interpretation of the paper). The function omits cells that the user changed with
/// --set, --axis or --model. It also omits a cell if its experiment lacks the axis model,
/// layers or size, or if another kind of table (such as RivalTable) contains the cell.
std::vector<PaperTable> paper_tables(const std::vector<Cell>& cells, const ModelNote& note);

/// Returns the table as text for a terminal, with a legend.
std::string text_of(const PaperTable& table);
/// Returns CSV with one line per cell of the table.
std::string csv_of(const PaperTable& table);
/// Returns the table in LaTeX (booktabs, threeparttable) for \input.
std::string latex_of(const PaperTable& table);
/// Returns a file name that is unique among the tables of one report.
std::string file_stem_of(const PaperTable& table, bool several_devices);

/// Returns the text with LaTeX's special characters escaped.
std::string latex_text(const std::string& text);

}  // namespace pelage
