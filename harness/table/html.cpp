// Writes tables as HTML.
#include <fmt/format.h>

#include <algorithm>

#include "harness/table/render.hpp"

namespace pelage {
namespace {

/// Returns a "td" element. The page sorts a table by the attribute data-sort of its cells, or else by their
/// text. data-cell contains Value::cell.
std::string cell_of(const std::optional<Value>& value) {
  if (!value) return "<td>-</td>";
  std::string attributes;
  if (value->failed) attributes += " class=\"bad\"";
  if (!value->hint.empty()) attributes += fmt::format(" title=\"{}\"", html_text(value->hint));
  if (value->data != value->shown) attributes += fmt::format(" data-sort=\"{}\"", html_text(value->data));
  if (value->cell >= 0) attributes += fmt::format(" data-cell=\"{}\"", value->cell);
  return fmt::format("<td{}>{}{}</td>", attributes, html_text(value->shown),
                     value->mark.empty() ? "" : fmt::format("<sup>{}</sup>", html_text(value->mark)));
}

std::string html_head(const Pivot& pivot, const Pivot::Block& block) {
  std::string text = "<thead>";
  if (pivot.grouped() || !block.label.empty()) {
    text += fmt::format("<tr><th colspan=\"{}\">{}</th>", std::max<std::size_t>(1, pivot.keys.size()),
                        html_text(joined(block.label)));
    for (const auto& group : pivot.groups)
      text += fmt::format("<th class=\"group\" colspan=\"{}\">{}</th>", pivot.values.size(),
                          html_text(joined(group)));
    text += "</tr>\n";
  }
  text += "<tr>";
  for (const Column& key : pivot.keys) text += fmt::format("<th>{}</th>", html_text(key.heading));
  for (std::size_t g = 0; g < pivot.groups.size(); ++g)
    for (const Column& value : pivot.values) text += fmt::format("<th>{}</th>", html_text(value.heading));
  return text + "</tr></thead>\n";
}

}  // namespace

std::string escaped(const std::string& text, const std::map<char, std::string_view>& escapes) {
  std::string result;
  for (const char c : text) {
    const auto escape = escapes.find(c);
    result += escape == escapes.end() ? std::string_view(&c, 1) : escape->second;
  }
  return result;
}

std::string html_text(const std::string& text) {
  static const std::map<char, std::string_view> escapes{
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  return escaped(text, escapes);
}

std::string html_of(const Table& table) {
  const Pivot pivot = pivot_of(table);
  std::string text;
  for (const Pivot::Block& block : pivot.blocks) {
    text += "<div class=\"wide\"><table>\n" + html_head(pivot, block) + "<tbody>\n";
    for (const Pivot::Row& row : block.rows) {
      text += "<tr>";
      for (const Value& key : row.keys) text += cell_of(key);
      for (const auto& cell : row.cells) text += cell_of(cell);
      text += "</tr>\n";
    }
    text += "</tbody></table></div>\n";
  }
  if (!table.remarks.empty()) {
    text += "<p class=\"soft\">";
    for (const std::string& remark : table.remarks) {
      if (&remark != &table.remarks.front()) text += ' ';
      text += html_text(remark);
    }
    text += "</p>\n";
  }
  if (!table.footnotes.empty()) {
    text += "<ol class=\"notes\">";
    for (const auto& [mark, note] : table.footnotes)
      text += fmt::format("<li><sup>{}</sup> {}</li>", html_text(mark), html_text(note));
    text += "</ol>\n";
  }
  return text;
}

}  // namespace pelage
