#include "harness/report/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <re2/re2.h>

#include <map>

#include "harness/error.hpp"

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

Verdict verdict_of(const Cell& a, const Cell& b, double change, double threshold) {
  if (a.median_ms <= 0) return Verdict::same;
  if (b.median_ms <= 0) return Verdict::lost;
  const bool apart = b.interval_ms.low > a.interval_ms.high || b.interval_ms.high < a.interval_ms.low;
  if (!apart || std::abs(change) <= threshold) return Verdict::same;
  return change > 0 ? Verdict::slower : Verdict::faster;
}

/// Throws InputError if the set contains two cells that differ only in their identity.
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
                                const CompareBy& by, double threshold) {
  refuse_ambiguous(a, by);
  refuse_ambiguous(b, by);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = one_set ? i + 1 : 0; j < b.size(); ++j) {
      const std::string name = common_name(a[i], by);
      if (common_name(b[j], by) != name) continue;
      Pair pair{name, value_of(a[i], by), value_of(b[j], by), a[i].median_ms, b[j].median_ms,
                0,    Verdict::same};
      if (pair.a_ms > 0 && pair.b_ms > 0) pair.change = pair.b_ms / pair.a_ms - 1;
      pair.verdict = verdict_of(a[i], b[j], pair.change, threshold);
      pairs.push_back(std::move(pair));
    }
  if (pairs.empty())
    throw InputError(
        by.text.empty()
            ? "A and B have no case in common on the same device; --by device compares results of "
              "different devices"
            : fmt::format("no two cases differ only in {}", by.text));
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
    case Verdict::lost:
      return "lost";
  }
  return "same";
}

double threshold_from_text(const std::string& text) {
  double number = 0;
  std::string percent;
  if (!RE2::FullMatch(text, R"(([0-9]{1,6}(?:\.[0-9]{1,9})?)(%?))", &number, &percent))
    throw InputError(fmt::format("--threshold '{}' is not a fraction; write for instance 5% or 0.05", text));
  return percent.empty() ? number : 0.01 * number;
}

}  // namespace pelage
