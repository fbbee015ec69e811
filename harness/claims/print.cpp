#include "harness/claims/print.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <set>

#include "harness/table/render.hpp"

namespace pelage::claims {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the number with three significant digits. Numbers between 0.98 and 1.02, except 1 itself, get four
/// decimals, because ratios near 1 need them. Numbers of at least 100 are rounded to whole numbers.
std::string number_text(double value) {
  if (std::abs(value - 1) < 0.02 && value != 1) return fmt::format("{:.4f}", value);
  return std::abs(value) >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string interval_text(double value, const Interval& interval) {
  if (interval.low == interval.high) return number_text(value);
  return fmt::format("{} [{}, {}]", number_text(value), number_text(interval.low),
                     number_text(interval.high));
}

/// Returns the claims of the papers, and those that are ours.
std::array<std::vector<Judged>, 2> by_origin(const std::vector<Judged>& judged) {
  std::array<std::vector<Judged>, 2> parts;
  for (const Judged& one : judged) parts[one.claim.ours() ? 1 : 0].push_back(one);
  return parts;
}

std::string kind_of(const Claim& claim) {
  return claim.absolute ? "absolute" : "shape";
}

/// A column of the table: its name, and a function that returns the claim's value in this column as JSON.
struct Column {
  const char* name;
  Json (*field)(const Judged&);
};

const std::vector<Column>& columns() {
  static const auto if_known = [](const std::optional<double>& value, const Json& field) {
    return value ? field : Json();
  };
  static const std::vector<Column> all{
      {"id", [](const Judged& j) { return Json(j.claim.id); }},
      {"verdict", [](const Judged& j) { return Json(to_text(j.verdict)); }},
      {"kind", [](const Judged& j) { return Json(kind_of(j.claim)); }},
      {"statement", [](const Judged& j) { return Json(j.claim.statement); }},
      {"test", [](const Judged& j) { return Json(j.claim.test); }},
      {"reading", [](const Judged& j) { return Json(j.claim.reading); }},
      {"paper", [](const Judged& j) { return Json(j.claim.paper); }},
      {"section", [](const Judged& j) { return Json(j.claim.section); }},
      {"experiment",
       [](const Judged& j) { return Json(fmt::format("{}", fmt::join(j.claim.experiments, ";"))); }},
      {"device", [](const Judged& j) { return Json(j.device); }},
      {"host", [](const Judged& j) { return Json(j.host); }},
      {"measured", [](const Judged& j) { return Json(description_of(j.claim)); }},
      {"relation", [](const Judged& j) { return Json(j.claim.relation); }},
      {"effect", [](const Judged& j) { return j.value ? Json(*j.value) : Json(); }},
      {"low", [](const Judged& j) { return if_known(j.value, j.interval.low); }},
      {"high", [](const Judged& j) { return if_known(j.value, j.interval.high); }},
      {"confidence", [](const Judged& j) { return if_known(j.value, j.confidence); }},
      {"effects", [](const Judged& j) { return if_known(j.value, j.effects); }},
      {"least", [](const Judged& j) { return if_known(j.value, j.least); }},
      {"most", [](const Judged& j) { return if_known(j.value, j.most); }},
      {"decisive", [](const Judged& j) { return Json(j.decisive); }},
      {"processes", [](const Judged& j) { return if_known(j.value, j.processes); }},
      {"paper_effect", [](const Judged& j) { return j.paper_value ? Json(*j.paper_value) : Json(); }},
      {"paper_low", [](const Judged& j) { return if_known(j.paper_value, j.paper_interval.low); }},
      {"paper_high", [](const Judged& j) { return if_known(j.paper_value, j.paper_interval.high); }},
      {"reason", [](const Judged& j) { return Json(j.reason); }},
      {"notes", [](const Judged& j) { return Json(fmt::format("{}", fmt::join(j.notes, "; "))); }}};
  return all;
}

std::string counts_of(const std::vector<Judged>& judged, std::string_view what) {
  if (judged.empty()) return {};
  std::array<std::size_t, 4> counts{};
  for (const Judged& one : judged) ++counts[std::size_t(one.verdict)];
  std::string text = fmt::format("{}, {}:", what, judged.size());
  for (std::size_t i = 0; i < counts.size(); ++i)
    text += fmt::format("{} {} {}", i == 0 ? "" : ",", counts[i], to_text(Verdict(i)));
  return text + "\n";
}

std::string details_of(const Judged& one) {
  std::string text;
  if (!one.claim.test.empty()) text += fmt::format("    test: {}\n", one.claim.test);
  if (one.value) {
    text += fmt::format("    {}: {}{}; the claim: {}", description_of(one.claim), effect_text(one),
                        effects_text(one), one.claim.relation);
    if (one.paper_value)
      text += fmt::format("; the paper's numbers: {}", interval_text(*one.paper_value, one.paper_interval));
    text += "\n";
  }
  if (!one.reason.empty()) text += fmt::format("    {}: {}\n", to_text(one.verdict), one.reason);
  for (const std::string& note : one.notes) text += fmt::format("    note: {}\n", note);
  return text;
}

}  // namespace

std::string source_of(const Claim& claim) {
  const bool number = claim.section.find_first_of("0123456789") == 0;
  const std::string section = number ? "section " + claim.section : claim.section;
  std::string text = claim.paper + (claim.paper.empty() || section.empty() ? "" : ", ") + section;
  if (!claim.reading.empty()) text += fmt::format("{}reading {}", text.empty() ? "" : ", ", claim.reading);
  return text.empty() ? "ours" : text;
}

std::string effects_text(const Judged& judged) {
  if (!judged.decisive.empty())
    return fmt::format(" for {}; {} effects from {} to {}", judged.decisive, judged.effects,
                       number_text(judged.least), number_text(judged.most));
  return judged.effects > 1 ? fmt::format(", from {} effects", judged.effects) : "";
}

std::string effect_text(const Judged& judged) {
  if (!judged.value) return {};
  std::string text = interval_text(*judged.value, judged.interval);
  if (judged.confidence > 0.951 && judged.interval.low != judged.interval.high)
    text += fmt::format(" at {:.3g}%", 100 * judged.confidence);
  return text;
}

std::string text_of(const std::vector<Judged>& judged, bool all) {
  std::string text, machine;
  std::set<std::string> experiments;
  std::size_t missing = 0;
  for (const Judged& one : judged) {
    if (one.no_rows && !all) {
      ++missing;
      experiments.insert(fmt::format("{}", fmt::join(one.claim.experiments, " or ")));
      continue;
    }
    const std::string own =
        one.device.empty() ? "" : fmt::format("{}{}{}", one.device, one.host.empty() ? "" : " on ", one.host);
    if (!own.empty() && own != machine) text += fmt::format("Device {}\n", machine = own);
    text += fmt::format("{:10} {}  ({}; {})\n    {}\n", to_text(one.verdict), one.claim.id,
                        kind_of(one.claim), source_of(one.claim), one.claim.statement);
    text += details_of(one);
  }
  if (missing > 0)
    text += fmt::format("{} of these experiments, which have no rows here: {}; --all lists {}\n",
                        missing == 1 ? "1 claim needs rows" : fmt::format("{} claims need rows", missing),
                        fmt::join(experiments, ", "), missing == 1 ? "it" : "them");
  const auto [papers, ours] = by_origin(judged);
  return text + counts_of(papers, "Claims of papers") + counts_of(ours, "Claims of our own");
}

std::vector<std::vector<std::string>> table_of(const std::vector<Judged>& judged) {
  std::vector<std::vector<std::string>> table(1);
  for (const Column& column : columns()) table[0].emplace_back(column.name);
  for (const Judged& one : judged) {
    table.emplace_back();
    for (const Column& column : columns()) {
      const Json field = column.field(one);
      table.back().push_back(field.is_null()           ? ""
                             : field.is_string()       ? field.get<std::string>()
                             : field.is_number_float() ? fmt::format("{:.10g}", field.get<double>())
                                                       : field.dump());
    }
  }
  return table;
}

namespace {

std::string markdown_table(const std::vector<Judged>& judged) {
  std::string text =
      "| claim | statement | source | measured | effect | relation | the paper's numbers | verdict |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  std::set<std::string> devices;
  for (const Judged& one : judged)
    if (!one.device.empty()) devices.insert(one.device);
  for (const Judged& one : judged) {
    std::string name = fmt::format("{}, {}", one.claim.id, kind_of(one.claim));
    if (devices.size() > 1 && !one.device.empty()) name += fmt::format(", {}", one.device);
    std::string verdict(to_text(one.verdict));
    if (!one.reason.empty()) verdict += ": " + one.reason;
    std::string effect = effect_text(one);
    if (!one.decisive.empty()) effect += fmt::format(" ({})", one.decisive);
    text += "|";
    for (const std::string& cell :
         {name, one.claim.statement, source_of(one.claim), description_of(one.claim), effect,
          one.value ? one.claim.relation : "",
          one.paper_value ? interval_text(*one.paper_value, one.paper_interval) : "", verdict})
      text += fmt::format(" {} |", escaped(cell, {{'|', "\\|"}}));
    text += "\n";
  }
  return text;
}

}  // namespace

std::string markdown_of(const std::vector<Judged>& judged) {
  const auto [papers, ours] = by_origin(judged);
  return (papers.empty() ? "" : markdown_table(papers)) +
         (ours.empty() ? "" : (papers.empty() ? "" : "\n## Findings of our own\n\n") + markdown_table(ours));
}

Json json_of(const std::vector<Judged>& judged) {
  Json list = Json::array();
  for (const Judged& one : judged) {
    Json object = Json::object();
    for (const Column& column : columns()) object[column.name] = column.field(one);
    list.push_back(std::move(object));
  }
  return list;
}

}  // namespace pelage::claims
