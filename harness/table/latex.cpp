// Writes tables as LaTeX. A cross table has blocks of rows and groups of columns (Layout in table.hpp).
#include <fmt/format.h>

#include <algorithm>

#include "harness/base/numbers.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

/// Returns the heading of a block or of a group of columns. Writes the x of a picture size such as "800x600"
/// as a multiplication sign.
std::string label_text(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    const std::optional<Size> size = size_from_text(part);
    text += (text.empty() ? "" : ", ") +
            (size ? fmt::format("${} \\times {}$", size->width, size->height) : latex_text(part));
  }
  return text;
}

std::string latex_cell(const Value& value) {
  return latex_text(value.shown) +
         (value.mark.empty() ? "" : fmt::format("\\tnote{{{}}}", latex_text(value.mark)));
}

std::string block_of(const Pivot& pivot, const Pivot::Block& block) {
  const std::size_t keys = pivot.keys.size(), count = pivot.values.size();
  std::string text;
  if (pivot.grouped() || !block.label.empty()) {
    text += fmt::format("\\multicolumn{{{}}}{{l}}{{{}}}", keys, label_text(block.label));
    for (const auto& group : pivot.groups)
      text += fmt::format(" & \\multicolumn{{{}}}{{c}}{{{}}}", count, label_text(group));
    text += " \\\\\n";
    for (std::size_t g = 0; g < pivot.groups.size() && count > 1; ++g)
      text += fmt::format("\\cmidrule(lr){{{}-{}}} ", keys + 1 + g * count, keys + (g + 1) * count);
    if (count > 1) text += "\n";
  }
  for (std::size_t k = 0; k < keys; ++k) text += (k > 0 ? " & " : "") + latex_text(pivot.keys[k].heading);
  for (std::size_t g = 0; g < pivot.groups.size(); ++g)
    for (const Column& value : pivot.values) text += " & " + latex_text(value.heading);
  text += " \\\\\n\\midrule\n";
  for (const Pivot::Row& row : block.rows) {
    for (std::size_t k = 0; k < keys; ++k) text += (k > 0 ? " & " : "") + latex_cell(row.keys[k]);
    for (const auto& cell : row.cells) text += " & " + (cell ? latex_cell(*cell) : "-");
    text += " \\\\\n";
  }
  return text;
}

}  // namespace

std::string latex_text(const std::string& text) {
  static const std::map<char, std::string_view> escapes{{'&', "\\&"},
                                                        {'%', "\\%"},
                                                        {'$', "\\$"},
                                                        {'#', "\\#"},
                                                        {'_', "\\_"},
                                                        // At the beginning of a row, [ would be an option of
                                                        // the command before it.
                                                        {'[', "{[}"},
                                                        {'{', "\\{"},
                                                        {'}', "\\}"},
                                                        {'<', "$<$"},
                                                        {'>', "$>$"},
                                                        {'\\', "\\textbackslash{}"},
                                                        {'~', "\\textasciitilde{}"},
                                                        {'^', "\\textasciicircum{}"}};
  return escaped(text, escapes);
}

std::string latex_of(const Table& table) {
  const Pivot pivot = pivot_of(table);
  std::string columns(pivot.keys.size() + pivot.groups.size() * pivot.values.size(), 'r');
  std::replace(columns.begin(), columns.begin() + std::min<std::ptrdiff_t>(1, std::ssize(columns)), 'r', 'l');
  // The table becomes smaller only if it is wider than a column.
  std::string text =
      "% needs \\usepackage{booktabs,threeparttable,adjustbox}\n"
      "\\begin{adjustbox}{max width=\\columnwidth}\n\\begin{threeparttable}\n" +
      fmt::format("\\begin{{tabular}}{{{}}}\n\\toprule\n", columns);
  for (const Pivot::Block& block : pivot.blocks)
    text += (&block == &pivot.blocks.front() ? "" : "\\midrule\n") + block_of(pivot, block);
  text += "\\bottomrule\n\\end{tabular}\n\\begin{tablenotes}\\footnotesize\n";
  if (!table.subtitle.empty()) text += fmt::format("\\item {}\n", latex_text(table.subtitle));
  for (const std::string& remark : table.remarks) text += fmt::format("\\item {}\n", latex_text(remark));
  for (const auto& [mark, note] : table.footnotes)
    text += fmt::format("\\item[{}] {}\n", latex_text(mark), latex_text(note));
  return text + "\\end{tablenotes}\n\\end{threeparttable}\n\\end{adjustbox}\n";
}

}  // namespace pelage
