#include "harness/report/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <re2/re2.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "harness/error.hpp"
#include "harness/measure/difference.hpp"
#include "harness/report/case_table.hpp"

namespace pelage {
namespace {

std::string value_of(const Cell& cell, const CompareBy& by) {
  if (by.text == "device") return cell.device + "@" + cell.host;
  if (by.text == "variant") return cell.variant;
  if (by.text.starts_with("axes.")) return cell.axis(by.text.substr(5));
  return {};
}

/// Returns the properties that must be equal in the two cells of a pair: all but the property that `by`
/// names.
std::vector<std::string> common_parts(const Cell& cell, const CompareBy& by) {
  std::vector<std::string> parts{cell.experiment};
  for (const auto& [key, value] : cell.axes)
    if (by.text != "axes." + key && key != "variant") parts.push_back(fmt::format("{}={}", key, value));
  for (const auto& [key, value] : cell.overrides)
    if (by.text != "axes." + key && cell.axis(key) != value)
      parts.push_back(fmt::format("[{}={}]", key, value));
  if (by.text != "variant" && by.text != "axes.variant") parts.push_back(cell.variant);
  if (by.text != "device") parts.push_back(cell.device + "@" + cell.host);
  return parts;
}

std::string common_name(const Cell& cell, const CompareBy& by) {
  return fmt::format("{}", fmt::join(common_parts(cell, by), " "));
}

/// The verdicts of Side::below, within, above and undecided.
constexpr Verdict of_side[] = {Verdict::faster, Verdict::same, Verdict::slower, Verdict::undecided};

/// Two cells to compare.
struct Match {
  const Cell *a, *b;
};

Match match_of(const Cell& a, const Cell& b, bool one_set, const CompareBy& by) {
  const bool swapped = one_set && natural_less(value_of(b, by), value_of(a, by));
  return swapped ? Match{&b, &a} : Match{&a, &b};
}

/// Calls use(i, j) for each cell i of A and j of B; if they are one set, once for each two cells.
template <class Use>
void each_two(std::size_t a, std::size_t b, bool one_set, const Use& use) {
  for (std::size_t i = 0; i < a; ++i)
    for (std::size_t j = one_set ? i + 1 : 0; j < b; ++j) use(i, j);
}

std::vector<Match> equal_names(const std::vector<Cell>& a, const std::vector<Cell>& b, bool one_set,
                               const CompareBy& by) {
  const auto name = [&](const Cell& cell) { return common_name(cell, by); };
  std::vector<std::string> left(a.size()), right(b.size());
  std::ranges::transform(a, left.begin(), name);
  std::ranges::transform(b, right.begin(), name);
  std::vector<Match> matches;
  each_two(a.size(), b.size(), one_set, [&](std::size_t i, std::size_t j) {
    if (left[i] == right[j]) matches.push_back(match_of(a[i], b[j], one_set, by));
  });
  return matches;
}

/// Adds the pairs of cells of one case on two devices that `matches` does not contain. Their variants may
/// differ (compare_cells()).
void add_equal_cases(std::vector<Match>& matches, const std::vector<Cell>& a, const std::vector<Cell>& b,
                     bool one_set, const CompareBy& by) {
  std::set<const Cell*> matched;
  for (const Match& m : matches) matched.insert({m.a, m.b});
  each_two(a.size(), b.size(), one_set, [&](std::size_t i, std::size_t j) {
    const Cell &x = a[i], &y = b[j];
    if (matched.contains(&x) || matched.contains(&y) || value_of(x, by) == value_of(y, by)) return;
    if (x.experiment == y.experiment && x.case_name == y.case_name && x.overrides == y.overrides)
      matches.push_back(match_of(x, y, one_set, by));
  });
}

Pair pair_of(const Cell& a, const Cell& b, const CompareBy& by) {
  Pair pair{.name = common_name(a, by),
            .parts = common_parts(a, by),
            .a = value_of(a, by),
            .b = value_of(b, by),
            .a_ms = timed(a) ? typical_ms(a.timings) : 0,
            .b_ms = timed(b) ? typical_ms(b.timings) : 0,
            .a_processes = a.timings.processes.size(),
            .b_processes = b.timings.processes.size(),
            .contended = a.contended || b.contended};
  if (by.text == "device" && a.variant != b.variant) {
    pair.name += " -> " + b.variant;
    pair.parts.push_back("-> " + b.variant);
  }
  if (timed(a) && !timed(b)) {
    pair.verdict = Verdict::lost;
    pair.reason = std::string(to_text(b.status));
    if (!b.reason.empty()) pair.reason += ": " + b.reason;
  }
  return pair;
}

void decide_pairs(std::vector<Pair>& pairs, const std::vector<std::optional<Difference>>& differences,
                  const CompareLimits& limits) {
  std::vector<Difference> known;
  for (const auto& difference : differences)
    if (difference) known.push_back(*difference);
  const std::vector<Decision> decisions = decide(known, limits.threshold, limits.alpha);
  for (std::size_t i = 0, k = 0; i < pairs.size(); ++i) {
    if (!differences[i]) continue;
    Pair& pair = pairs[i];
    const Difference& difference = *differences[i];
    const Decision& decision = decisions[k++];
    pair.change = std::expm1(difference.log_ratio);
    pair.interval = {decision.ratio.low - 1, decision.ratio.high - 1};
    pair.confidence = decision.confidence;
    pair.p = decision.p;
    pair.paired = difference.paired;
    pair.assumed = difference.assumed;
    pair.detectable = detectable_change(difference, known.size(), limits.threshold, limits.alpha);
    pair.verdict = of_side[std::size_t(decision.side)];
    if (pair.verdict == Verdict::undecided)
      pair.needed = processes_needed(difference, std::min(pair.a_processes, pair.b_processes), known.size(),
                                     limits.threshold, limits.alpha);
  }
}

void refuse_ambiguous(const std::vector<Cell>& cells, const CompareBy& by) {
  std::map<std::pair<std::string, std::string>, const Cell*> known;
  for (const Cell& cell : cells) {
    const auto [place, added] = known.try_emplace({common_name(cell, by), value_of(cell, by)}, &cell);
    if (!added)
      throw InputError(fmt::format(
          "{}: one set of results contains two measurements of this case with different inputs ({}); compare each measurement with the other set separately",
          place->first.first, fmt::join(differing_parts(place->second->identity, cell.identity), ", ")));
  }
}

}  // namespace

CompareBy::CompareBy(const std::string& by) : text(by) {
  if (!by.empty() && by != "device" && by != "variant" && (!by.starts_with("axes.") || by == "axes."))
    throw InputError(fmt::format("--by '{}' is not device, variant or axes.KEY", by));
}

std::vector<Pair> compare_cells(const std::vector<Cell>& a, const std::vector<Cell>& second_set, bool one_set,
                                const CompareBy& by, const CompareLimits& limits) {
  const std::vector<Cell>& b = one_set ? a : second_set;  // a copy of a cell would count as another cell
  refuse_ambiguous(a, by);
  refuse_ambiguous(b, by);
  std::vector<Match> matches = equal_names(a, b, one_set, by);
  if (by.text == "device") add_equal_cases(matches, a, b, one_set, by);
  std::vector<Pair> pairs;
  std::vector<std::optional<Difference>> differences;  // one per pair; empty if a time is missing
  for (const auto& [first, second] : matches) {
    pairs.push_back(pair_of(*first, *second, by));
    differences.push_back(timed(*first) && timed(*second)
                              ? std::optional(difference_of(first->timings, second->timings))
                              : std::nullopt);
  }
  if (pairs.empty())
    throw InputError(
        by.text.empty()
            ? "A and B have no case in common on the same device; --by device compares results of different devices"
            : fmt::format("no two cases differ only in {}", by.text));
  decide_pairs(pairs, differences, limits);
  return pairs;
}

std::string_view to_text(Verdict verdict) {
  static constexpr std::string_view names[] = {"same", "faster", "slower", "undecided", "lost"};
  return names[std::size_t(verdict)];
}

namespace {

/// Returns the properties of the first pair that all pairs have.
std::vector<std::string> shared_parts(const std::vector<Pair>& pairs) {
  std::vector<std::string> shared = pairs.front().parts;
  if (pairs.size() > 1)
    std::erase_if(shared, [&](const std::string& part) {
      return std::ranges::any_of(pairs,
                                 [&](const Pair& p) { return std::ranges::count(p.parts, part) == 0; });
    });
  return shared;
}

std::string percent(double fraction) {
  return fmt::format("{:+.1f}%", 100 * fraction);
}

}  // namespace

Table comparison_table(const std::vector<Pair>& pairs, const CompareBy& by, const std::string& a,
                       const std::string& b) {
  const bool one = std::ranges::all_of(
      pairs, [&](const Pair& p) { return p.a == pairs.front().a && p.b == pairs.front().b; });
  const std::string key = by.text.starts_with("axes.") ? by.text.substr(5) : by.text;
  const auto heading = [&](const std::string& side, const std::string& value) {
    if (!one || value.empty()) return fmt::format("{}, ms", side);
    return key == "device" || key == "variant" ? fmt::format("{}, ms", value)
                                               : fmt::format("{}={}, ms", key, value);
  };
  Table table;
  table.title =
      by.text.empty() ? fmt::format("Frame times of {} and {}", a, b) : fmt::format("Frame times by {}", key);
  table.stem = "comparison";
  table.columns = {{"case", "case"},
                   {"a", key + " A"},
                   {"b", key + " B"},
                   {"a_ms", heading(a, pairs.front().a)},
                   {"b_ms", heading(b, pairs.front().b)},
                   {"change", "change"},
                   {"change_low", "low"},
                   {"change_high", "high"},
                   {"verdict", "verdict"}};
  table.layout = {{}, {"case"}, {}, {"a_ms", "b_ms", "change", "verdict"}};
  if (!one) table.layout.rows.insert(table.layout.rows.end(), {"a", "b"});
  const std::vector<std::string> shared = shared_parts(pairs);
  table.subtitle = fmt::format("{}", fmt::join(shared, " "));
  for (const Pair& p : pairs) {
    std::vector<std::string> own;
    for (const std::string& part : p.parts)
      if (std::ranges::count(shared, part) == 0) own.push_back(part);
    const bool both = p.a_ms > 0 && p.b_ms > 0;
    const auto time = [](double ms) { return number_value(ms > 0 ? std::optional(ms) : std::nullopt); };
    const auto change = [&](double fraction) {
      return both ? Value{fmt::format("{:.6g}", 100 * fraction), percent(fraction)} : number_value({});
    };
    table.lines.push_back({text_value(own.empty() ? "all" : fmt::format("{}", fmt::join(own, " "))),
                           text_value(p.a), text_value(p.b), time(p.a_ms), time(p.b_ms), change(p.change),
                           change(p.interval.low), change(p.interval.high),
                           text_value(std::string(to_text(p.verdict)) + (p.contended ? " !" : ""))});
  }
  std::ranges::stable_sort(table.lines, natural_less, [](const auto& line) { return line.front().data; });
  show_interval(table, "change");
  table.remarks = {
      "Change: relative change of the time from the first to the second, and its confidence interval."};
  if (std::ranges::any_of(pairs, &Pair::contended)) table.remarks.push_back(contended_remark());
  return table;
}

PlotSpec comparison_plot(const Table& table) {
  PlotSpec plot;
  plot.title = table.title;
  plot.stem = table.stem;
  plot.x = "case";
  plot.y = "change";
  const auto side = [&](const char* column) {
    const std::string heading = table.columns[std::size_t(column_of(table, column))].heading;
    return heading.substr(0, heading.rfind(", ms"));
  };
  plot.y_label = fmt::format("change of the time from\n{} to {}, %", side("a_ms"), side("b_ms"));
  plot.low = "change_low";
  plot.high = "change_high";
  plot.guide = 0;
  plot.bars = true;
  if (std::ranges::count(table.layout.rows, "a") > 0) plot.series = {"a", "b"};
  return plot;
}

double fraction_from_text(const std::string& option, const std::string& text) {
  double number = 0;
  std::string percent;
  if (!RE2::FullMatch(text, R"(([0-9]{1,6}(?:\.[0-9]{1,9})?)(%?))", &number, &percent))
    throw InputError(fmt::format("{} '{}' is not a fraction; write for instance 5% or 0.05", option, text));
  return percent.empty() ? number : 0.01 * number;
}

}  // namespace pelage
