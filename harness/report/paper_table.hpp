// The paper's own table, ours beside theirs: a block per layer count, a row per model, columns per picture
// size.
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
    std::string note;                        ///< footnote mark, "a", "b" ...; "" for none
    std::vector<std::optional<Cell>> cells;  ///< per size
  };
  struct Block {
    std::string layers;
    std::vector<Row> rows;
  };
  std::string experiment, variant, device, host, reading;
  std::string title, source, hardware;  ///< what the paper's table is, and what its figures were taken on
  std::vector<std::string> sizes;
  std::vector<Block> blocks;
  std::vector<std::string> footnotes;  ///< "a: stand-in ..."
};

/// A cell as every form of the table shows it: ours (or the status), the paper's, the ratio; "-" for none.
struct CellText {
  std::string ours, paper, ratio;
};
CellText cell_text(const Cell& cell);

/// What a footnote must say of a model; "" for a model that needs none.
using ModelNote = std::function<std::string(const std::string& model)>;

/// One table per experiment, device and reading out of the cells that are the experiment's own (no overrides)
/// and have the axes model, layers and size.
std::vector<PaperTable> paper_tables(const std::vector<Cell>& cells, const ModelNote& note);

/// As text for a terminal, with a legend.
std::string text_of(const PaperTable& table);
/// One line per cell, for programs.
std::string csv_of(const PaperTable& table);
/// A LaTeX table (booktabs, threeparttable), to be \input.
std::string latex_of(const PaperTable& table);
/// A name fit for a file, unique among the tables of one report.
std::string file_stem_of(const PaperTable& table, bool several_devices);

/// Text with LaTeX's special characters escaped.
std::string latex_text(const std::string& text);

}  // namespace pelage
