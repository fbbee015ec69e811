#include "harness/report/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <re2/re2.h>

#include <cmath>
#include <map>
#include <optional>

#include "harness/error.hpp"
#include "harness/measure/difference.hpp"
#include "harness/table/table.hpp"

namespace pelage {
namespace {

std::string value_of(const Cell& cell, const CompareBy& by) {
  if (by.text == "device") return cell.device + "@" + cell.host;
  if (by.text == "variant") return cell.variant;
  if (by.text.starts_with("axes.")) return cell.axis(by.text.substr(5));
  return {};
}

/// Returns a text of all properties that must be equal in the two cells of a pair. The properties are the
/// experiment, the axes, the overrides, the variant and the device. The text does not contain the property
/// that `by` names.
std::string common_name(const Cell& cell, const CompareBy& by) {
  std::string name = cell.experiment;
  for (const auto& [key, value] : cell.axes)
    if (by.text != "axes." + key && key != "variant") name += fmt::format(" {}={}", key, value);
  for (const auto& [key, value] : cell.overrides)
    if (by.text != "axes." + key) name += fmt::format(" [{}={}]", key, value);
  if (by.text != "variant" && by.text != "axes.variant") name += " " + cell.variant;
  if (by.text != "device") name += " " + cell.device + "@" + cell.host;
  return name;
}

bool timed(const Cell& cell) {
  return cell.median_ms > 0;
}

Verdict verdict_of(Side side) {
  switch (side) {
    case Side::below:
      return Verdict::faster;
    case Side::within:
      return Verdict::same;
    case Side::above:
      return Verdict::slower;
    case Side::undecided:
      break;
  }
  return Verdict::undecided;
}

Pair pair_of(const Cell& a, const Cell& b, std::string name, const CompareBy& by) {
  Pair pair;
  pair.name = std::move(name);
  pair.a = value_of(a, by);
  pair.b = value_of(b, by);
  pair.a_ms = a.median_ms;
  pair.b_ms = b.median_ms;
  pair.a_processes = a.timings.processes.size();
  pair.b_processes = b.timings.processes.size();
  pair.contended = a.contended || b.contended;
  if (timed(a) && !timed(b)) pair.verdict = Verdict::lost;
  return pair;
}

/// Computes the change, its interval and the verdict of each pair. Skips a pair if one of its cells has no
/// time.
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
    pair.verdict = verdict_of(decision.side);
  }
}

/// Throws InputError if the set contains two cells that differ only in their identity (hashes of the inputs).
void refuse_ambiguous(const std::vector<Cell>& cells, const CompareBy& by) {
  std::map<std::pair<std::string, std::string>, const Cell*> known;
  for (const Cell& cell : cells) {
    const auto [place, added] = known.try_emplace({common_name(cell, by), value_of(cell, by)}, &cell);
    if (added) continue;
    throw InputError(fmt::format(
        "{}: one set of results contains two measurements of this case with different inputs ({}); compare "
        "each measurement with the other set separately",
        place->first.first, fmt::join(differing_parts(place->second->identity, cell.identity), ", ")));
  }
}

}  // namespace

CompareBy::CompareBy(const std::string& by) : text(by) {
  if (!by.empty() && by != "device" && by != "variant" && !(by.starts_with("axes.") && by.size() > 5))
    throw InputError(fmt::format("--by '{}' is not device, variant or axes.KEY", by));
}

std::vector<Pair> compare_cells(const std::vector<Cell>& a, const std::vector<Cell>& b, bool one_set,
                                const CompareBy& by, const CompareLimits& limits) {
  refuse_ambiguous(a, by);
  refuse_ambiguous(b, by);
  std::vector<Pair> pairs;
  std::vector<std::optional<Difference>> differences;  // one per pair; empty if a time is missing
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = one_set ? i + 1 : 0; j < b.size(); ++j) {
      std::string name = common_name(a[i], by);
      if (common_name(b[j], by) != name) continue;
      const bool swapped = one_set && natural_less(value_of(b[j], by), value_of(a[i], by));
      const Cell &first = swapped ? b[j] : a[i], &second = swapped ? a[i] : b[j];
      pairs.push_back(pair_of(first, second, std::move(name), by));
      differences.push_back(timed(first) && timed(second)
                                ? std::optional(difference_of(first.timings, second.timings))
                                : std::nullopt);
    }
  if (pairs.empty())
    throw InputError(
        by.text.empty()
            ? "A and B have no case in common on the same device; --by device compares results of "
              "different devices"
            : fmt::format("no two cases differ only in {}", by.text));
  decide_pairs(pairs, differences, limits);
  return pairs;
}

std::string_view to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::same:
      return "same";
    case Verdict::faster:
      return "faster";
    case Verdict::slower:
      return "slower";
    case Verdict::undecided:
      break;
    case Verdict::lost:
      return "lost";
  }
  return "undecided";
}

double fraction_from_text(const std::string& option, const std::string& text) {
  double number = 0;
  std::string percent;
  if (!RE2::FullMatch(text, R"(([0-9]{1,6}(?:\.[0-9]{1,9})?)(%?))", &number, &percent))
    throw InputError(fmt::format("{} '{}' is not a fraction; write for instance 5% or 0.05", option, text));
  return percent.empty() ? number : 0.01 * number;
}

}  // namespace pelage
