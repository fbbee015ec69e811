#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/record/shards.hpp"
#include "harness/report/report.hpp"

namespace pelage {
namespace {

/// Maximum length of a reason in the table, in bytes. Without this limit, a compiler's log in the reason
/// could make the table unreadable.
constexpr std::size_t longest_reason = 300;

std::string first_line(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  std::size_t end = std::min(line.size(), longest_reason);
  while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xc0) == 0x80)
    --end;  // inside a UTF-8 character
  line.resize(end);
  if (line.size() < text.size()) line += " ...";
  return line;
}

std::string place_of(const Cell& cell) {
  std::string place = fmt::format("{} on {}", cell.variant, cell.device);
  if (const std::string changes = changes_of(cell.overrides); !changes.empty())
    place += fmt::format("; changed: {}", changes);
  return place;
}

/// Returns text such as "7 of 8" or "3 of 8 in shard 1/4; 1 more ended with an error", or text_of() the gap
/// if the number is unknown.
std::string missing_text(const Gap& gap) {
  if (!gap.expected || *gap.expected < gap.done + gap.failed) return text_of(gap);
  std::string text = fmt::format("{} of {}", *gap.expected - gap.done - gap.failed, *gap.expected);
  if (gap.count > 1 && !gap.whole_run) text += fmt::format(" in shard {}/{}", gap.index, gap.count);
  if (gap.whole_run) text += " in the whole run";
  if (gap.failed > 0) text += fmt::format("; {} more ended with an error", gap.failed);
  return text;
}

}  // namespace

std::vector<LeftOut> missing_cases(const std::vector<std::filesystem::path>& journals,
                                   const std::vector<FoundRow>& rows) {
  std::vector<LeftOut> list;
  for (const RunState& state : run_states(journals, rows))
    for (const Gap& gap : state.gaps)
      list.push_back(
          {state.experiment, "", state.where, fmt::format("cases without a row: {}", missing_text(gap))});
  return list;
}

std::vector<LeftOut> without_numbers(const std::vector<Cell>& cells, const std::vector<FoundRow>& rows) {
  std::vector<LeftOut> list;
  std::set<std::pair<std::string, std::string>>
      with_ratio;  // experiment and variant of cells with opengl_ratio
  for (const Cell& c : cells)
    if (c.metrics.contains("opengl_ratio")) with_ratio.insert({c.experiment, c.variant});
  for (const Cell& c : cells) {
    std::string reason;
    if (c.status != Status::ok)
      reason = fmt::format("no time: {}: {}", to_text(c.status), first_line(c.reason));
    else if (c.median_ms <= 0)
      reason = "no time: the row has no times of frames";
    else if (with_ratio.contains({c.experiment, c.variant}) && !c.metrics.contains("opengl_ratio"))
      reason = "no ratio: the row does not contain the time of the OpenGL baseline";
    if (!reason.empty()) list.push_back({c.experiment, c.case_name, place_of(c), reason});
  }
  for (const FoundRow& found : rows)
    if (const std::string note = provenance_text(found.row, "event_times"); !note.empty())
      list.push_back({found.row.experiment, found.row.case_name, found.journal.string(),
                      fmt::format("event times {}", note)});
  return list;
}

Section left_out_section(const std::vector<LeftOut>& list) {
  Section section;
  Table& table = section.table;
  table.title = "Left out";
  table.subtitle = "Cases without a time, and parts of the journals that are in no other table";
  table.stem = "left-out";
  table.columns = {{"experiment", "experiment"}, {"case", "case"}, {"where", "where"}, {"reason", "reason"}};
  table.layout = {{}, {"experiment", "case", "where"}, {}, {"reason"}};
  for (const LeftOut& one : list) {
    std::vector<Value>& line = table.lines.emplace_back();
    for (const std::string& text : {one.experiment, one.case_name, one.where, one.reason})
      line.push_back({text, text.empty() ? "-" : text});
  }
  return section;
}

}  // namespace pelage
