// Writes tables as text for a terminal.
#include <fmt/format.h>

#include <algorithm>

#include "harness/table/render.hpp"

namespace pelage {
namespace {

using Widths = std::vector<std::size_t>;

constexpr std::size_t between_values = 1, between_groups = 3;

std::string right(const std::string& text, std::size_t width) {
  return fmt::format("{:>{}}", text, width);
}

std::string text_cell(const std::optional<Value>& value) {
  if (!value) return "-";
  return value->mark.empty() ? value->shown : value->shown + " " + value->mark;
}

/// Whether the head of the table has a second line, with the headings of the values below those of the
/// groups.
bool two_heads(const Pivot& pivot) {
  return !pivot.grouped() || pivot.values.size() > 1;
}

/// Returns the width of each column in characters: first the key columns, then the columns of each group.
Widths widths_of(const Pivot& pivot) {
  Widths widths;
  for (std::size_t k = 0; k < pivot.keys.size(); ++k) {
    std::size_t width = pivot.keys[k].heading.size();
    for (const Pivot::Block& block : pivot.blocks) {
      if (k == 0) width = std::max(width, joined(block.label).size());
      for (const Pivot::Row& row : block.rows) width = std::max(width, text_cell(row.keys[k]).size());
    }
    widths.push_back(width);
  }
  for (std::size_t g = 0; g < pivot.groups.size(); ++g) {
    std::size_t sum = 0;
    for (std::size_t v = 0; v < pivot.values.size(); ++v) {
      std::size_t width = two_heads(pivot) ? pivot.values[v].heading.size() : 0;
      for (const Pivot::Block& block : pivot.blocks)
        for (const Pivot::Row& row : block.rows)
          width = std::max(width, text_cell(row.cells[g * pivot.values.size() + v]).size());
      widths.push_back(width);
      sum += width + (v > 0 ? between_values : 0);
    }
    if (const std::size_t need = joined(pivot.groups[g]).size(); need > sum && !pivot.values.empty())
      widths.back() += need - sum;
  }
  return widths;
}

/// The first key column is left-aligned, and the others are right-aligned.
std::string keys_line(const std::vector<std::string>& texts, const Widths& widths) {
  std::string line;
  for (std::size_t k = 0; k < texts.size(); ++k)
    line += k == 0 ? fmt::format("{:<{}}", texts[k], widths[k]) : "  " + right(texts[k], widths[k]);
  return line;
}

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string text_head(const Pivot& pivot, const Pivot::Block& block, const Widths& widths) {
  const std::size_t count = pivot.values.size();
  std::vector<std::string> names;
  for (const Column& key : pivot.keys) names.push_back(key.heading);
  std::string groups, values;
  for (std::size_t g = 0; g < pivot.groups.size(); ++g) {
    std::size_t sum = 0;
    for (std::size_t v = 0; v < count; ++v) {
      const std::size_t width = widths[pivot.keys.size() + g * count + v];
      values +=
          std::string(v == 0 ? between_groups : between_values, ' ') + right(pivot.values[v].heading, width);
      sum += width + (v > 0 ? between_values : 0);
    }
    const std::string label = joined(pivot.groups[g]);
    groups += std::string(between_groups, ' ') +
              (count > 1 ? fmt::format("{:^{}}", label, sum) : right(label, sum));
  }
  const std::string label = joined(block.label);
  if (!two_heads(pivot)) {
    if (!label.empty()) names[0] = label;
    return trimmed(keys_line(names, widths) + groups);
  }
  std::vector<std::string> above(names.size());
  if (!above.empty()) above[0] = label;
  std::string text;
  if (pivot.grouped() || !label.empty())
    text += trimmed(keys_line(above, widths) + (pivot.grouped() ? groups : ""));
  return text + trimmed(keys_line(names, widths) + values);
}

}  // namespace

std::string text_of(const Table& table) {
  const Pivot pivot = pivot_of(table);
  const Widths widths = widths_of(pivot);
  std::string text = table.title + (table.subtitle.empty() ? "" : ": " + table.subtitle) + "\n";
  if (!table.answer.empty()) text += table.answer + "\n";
  for (const Pivot::Block& block : pivot.blocks) {
    text += '\n';
    text += text_head(pivot, block, widths);
    for (const Pivot::Row& row : block.rows) {
      std::vector<std::string> keys;
      for (const Value& key : row.keys) keys.push_back(text_cell(key));
      std::string line = keys_line(keys, widths);
      for (std::size_t i = 0; i < row.cells.size(); ++i)
        line += std::string(i % pivot.values.size() == 0 ? between_groups : between_values, ' ') +
                right(text_cell(row.cells[i]), widths[row.keys.size() + i]);
      text += trimmed(std::move(line));
    }
  }
  text += "\n";
  for (const std::string& remark : table.remarks) text += remark + "\n";
  for (const auto& [mark, note] : table.footnotes) text += fmt::format("{} {}\n", mark, note);
  return text;
}

}  // namespace pelage
