#include "harness/claims/judge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "harness/claims/cells.hpp"
#include "harness/claims/effects.hpp"

namespace pelage::claims {
namespace {

constexpr double significance = 0.05;

/// Returns how many draws contradict the measurement, because they are inside the region and it is outside,
/// or vice versa. All effects have equally many draws, so that their p-values increase with this number, up
/// to half of the draws, at which the p-value is 1.
std::ptrdiff_t contradicting(const Estimate& estimate, const Region& region) {
  const bool inside = region.contains(estimate.value);
  const auto against = [&](double draw) { return region.contains(draw) != inside; };
  return std::min(std::ranges::count_if(estimate.draws, against), std::ssize(estimate.draws) / 2);
}

}  // namespace

std::string_view to_text(Verdict verdict) {
  static constexpr std::string_view names[] = {"holds", "fails", "undecided", "untestable"};
  return names[std::size_t(verdict)];
}

double margin(const Region& region, double value) {
  double least = std::numeric_limits<double>::infinity();
  if (region.low) least = std::min(least, value - *region.low);
  if (region.high) least = std::min(least, *region.high - value);
  return least;
}

Decision decide(const std::vector<Estimate>& estimates, const Region& region) {
  std::set<std::pair<std::ptrdiff_t, std::size_t>> order;  // contradicting draws, index of the estimate
  for (const Estimate& one : estimates) order.emplace(contradicting(one, region), order.size());

  std::vector<Decision> each(estimates.size());
  std::size_t left = estimates.size();
  bool stopped = false;
  for (const auto& [against, i] : order) {
    const double rest = significance / double(left--);
    const std::vector<double>& draws = estimates[i].draws;
    const Interval interval{quantile(draws, rest / 2), quantile(draws, 1 - rest / 2)};
    each[i] = {Verdict::undecided, i, interval, 1 - rest};
    if (stopped) continue;
    if (region.contains(interval.low, interval.high))
      each[i].verdict = Verdict::holds;
    else if (region.outside(interval.low, interval.high))
      each[i].verdict = Verdict::fails;
    else
      stopped = true;
  }
  const auto any = [&](Verdict one) { return std::ranges::count(each, one, &Decision::verdict) > 0; };
  const Verdict verdict = any(Verdict::fails)       ? Verdict::fails
                          : any(Verdict::undecided) ? Verdict::undecided
                                                    : Verdict::holds;
  // Of the undecided estimates, those behind the one at which Holm's method stopped may have intervals
  // without a limit. The one at which it stopped has an interval with a limit, and is named.
  const auto clear = [&](const Decision& one) {
    return one.verdict == Verdict::undecided && (region.contains(one.interval.low, one.interval.high) ||
                                                 region.outside(one.interval.low, one.interval.high));
  };
  return *std::ranges::min_element(each, {}, [&](const Decision& one) {
    return std::tuple(one.verdict != verdict, clear(one), margin(region, estimates[one.decisive].value));
  });
}

namespace {

std::vector<double> effects_of(const Claim& claim, const std::vector<Part>& parts,
                               const std::vector<Value>& values) {
  std::vector<double> effects;
  effects.reserve(parts.size());
  for (const Part& part : parts) effects.push_back(effect_of(claim, part, values));
  return effects;
}

/// Returns one estimate per part, or a single estimate if the claim combines the effects of its parts. More
/// separate decisions use wider intervals, near whose limits draws are rare, and therefore need more draws.
template <class Draw>
std::vector<Estimate> estimates_of(const Claim& claim, const std::vector<Part>& parts,
                                   std::vector<Draw> cells) {
  std::vector<Value> values(cells.size());
  const auto compute = [&] {
    std::vector<double> effects = effects_of(claim, parts, values);
    if (claim.combine != Combine::every && parts.size() != 1) effects = {combined(claim, effects)};
    return effects;
  };
  std::ranges::transform(cells, values.begin(), &Draw::measured);
  std::vector<Estimate> result;
  for (const double effect : compute()) result.push_back({effect, {}});
  for (std::size_t d = 0; d < std::max<std::size_t>(2000, 100 * result.size()); ++d) {
    std::ranges::transform(cells, values.begin(), &Draw::drawn);
    auto estimate = result.begin();
    for (const double effect : compute()) (estimate++)->draws.push_back(effect);
  }
  return result;
}

std::vector<Drawing> drawings_of(const ClaimFile& file, const Claim& claim, const std::vector<Cell>& cells,
                                 double spread) {
  std::vector<Drawing> drawings;
  drawings.reserve(cells.size());
  for (const Cell& cell : cells) drawings.emplace_back(claim, cell, spread, file.separate_processes);
  return drawings;
}

/// Adds the effect of published frame rates, if enough cases have one.
void add_paper(Judged& judged, const std::vector<Cell>& cells) {
  const Claim& claim = judged.claim;
  std::vector<Cell> given;
  std::vector<PaperDrawing> drawings;
  for (const Cell& cell : cells)
    if (PaperDrawing::possible(claim, cell)) given.push_back(cell);
  std::vector<std::string> ignored;
  const std::vector<Part> parts = parts_of(claim, given, ignored);
  if (parts.empty()) return;
  drawings.reserve(given.size());
  for (const Cell& cell : given) drawings.emplace_back(claim, cell);
  const std::vector<Estimate> estimates = estimates_of(claim, parts, drawings);
  const Decision decision = decide(estimates, claim.region);
  judged.paper_value = estimates[decision.decisive].value;
  judged.paper_interval = decision.interval;
}

/// Returns up to three of the texts, separated by semicolons, and the number of the others.
std::string some_of(const std::vector<std::string>& texts) {
  const std::size_t shown = std::min<std::size_t>(3, texts.size());
  std::string text = fmt::format("{}", fmt::join(texts.begin(), texts.begin() + std::ptrdiff_t(shown), "; "));
  if (texts.size() > shown) text += fmt::format("; and {} more", texts.size() - shown);
  return text;
}

bool finite(const std::vector<Estimate>& estimates) {
  return std::ranges::all_of(estimates, [](const Estimate& estimate) {
    return std::isfinite(estimate.value) &&
           std::ranges::all_of(estimate.draws, [](double d) { return std::isfinite(d); });
  });
}

/// Whether at least half of the times of a cell of the part are those of a loaded machine.
bool contended(const Claim& claim, const Part& part, const std::vector<Cell>& cells) {
  return claim.quantity != Quantity::metric && std::ranges::any_of(part.cells, [&](std::size_t i) {
           return 2 * cells[i].contended >= cells[i].processes.size();
         });
}

/// Withdraws a verdict that rests on rows of a loaded machine.
void doubt_contended(Judged& judged, const std::vector<Part>& parts, const std::vector<Cell>& cells,
                     const std::vector<Estimate>& estimates, std::size_t decisive) {
  const Claim& claim = judged.claim;
  if (claim.combine != Combine::every || !contended(claim, parts[decisive], cells)) return;
  std::vector<Estimate> quiet;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!contended(claim, parts[i], cells)) quiet.push_back(estimates[i]);
  if (judged.verdict == Verdict::fails && !quiet.empty() &&
      decide(quiet, claim.region).verdict == Verdict::fails)
    return;
  judged.verdict = Verdict::undecided;
  judged.reason = "the rows that decide were measured while other processes used the CPU; measure them again";
}

void explain_undecided(Judged& judged, const Decision& without_spread, std::size_t wanted) {
  if (without_spread.verdict == Verdict::undecided)
    judged.reason = "the interval contains a limit of the relation";
  else
    judged.reason = fmt::format(
        "the rows come from {} of the {} processes that are needed. pelage therefore assumes that times vary by {:g}% between processes, and with this variation the interval contains a limit of the relation. Run the experiment with --repeat {}",
        judged.processes, wanted, 100 * judged.claim.process_spread, wanted);
}

void judge_rows(const ClaimFile& file, Judged& judged, const std::vector<const Row*>& rows) {
  const Claim& claim = judged.claim;
  const Cells cells = cells_of(claim, rows);
  std::vector<std::string> left_out = cells.left_out;
  const std::vector<Part> parts = parts_of(claim, cells.cells, left_out);
  const std::size_t count = claim.effect == Effect::share_of_cases ? cells.cells.size() : parts.size();
  if (!left_out.empty())
    judged.notes.push_back(fmt::format("{} left out: {}", left_out.size(), some_of(left_out)));
  if (cells.contended > 0)
    judged.notes.push_back(
        fmt::format("{} rows were measured while other processes used the CPU", cells.contended));
  if (count < claim.cases) {
    judged.reason =
        fmt::format("{} of the {} effects that decide the claim are measured", count, claim.cases);
    const std::vector<std::string> unknown = unknown_values(claim, rows);
    for (const std::string& text : unknown) judged.reason += "; " + text;
    if (unknown.empty() && cells.cells.empty() && left_out.empty())
      judged.reason += "; no row has all axis values of the claim";
    return;
  }
  if (claim.combine == Combine::every && parts.size() > most_effects) {
    judged.reason = fmt::format(
        "{} effects are too many for separate decisions (at most {}); narrow `where`, or combine the effects",
        parts.size(), most_effects);
    return;
  }
  std::vector<Drawing> drawings = drawings_of(file, claim, cells.cells, claim.process_spread);
  const std::vector<Estimate> estimates = estimates_of(claim, parts, drawings);
  if (!finite(estimates)) {
    judged.reason = "the effect is not a finite number, because a quantity is 0, negative or not finite";
    return;
  }
  const Decision decision = decide(estimates, claim.region);
  judged.verdict = decision.verdict;
  judged.value = estimates[decision.decisive].value;
  judged.interval = decision.interval;
  judged.confidence = decision.confidence;
  judged.effects = count;
  judged.processes = cells.cells.front().processes.size();
  for (const Cell& cell : cells.cells) judged.processes = std::min(judged.processes, cell.processes.size());
  std::vector<Value> values(drawings.size());
  std::ranges::transform(drawings, values.begin(), &Drawing::measured);
  const auto [least, most] = std::ranges::minmax(effects_of(claim, parts, values));
  judged.least = least;
  judged.most = most;
  if (claim.combine == Combine::every && parts.size() > 1) judged.decisive = parts[decision.decisive].name;
  if (decision.verdict == Verdict::undecided)
    explain_undecided(
        judged, decide(estimates_of(claim, parts, drawings_of(file, claim, cells.cells, 0)), claim.region),
        std::size_t(file.separate_processes));
  add_paper(judged, cells.cells);
  if (decision.verdict == Verdict::fails)
    judged.reason =
        !claim.why.empty() ? claim.why
        : claim.absolute
            ? "the claim depends on the device's speed, and this device is slower than the paper's"
            : "";
  if (judged.verdict != Verdict::undecided)
    doubt_contended(judged, parts, cells.cells, estimates, decision.decisive);
  if (!claim.hardware.empty() && judged.device.find(claim.hardware) == std::string::npos) {
    judged.verdict = Verdict::untestable;
    judged.reason = fmt::format("the claim is about the paper's hardware ({})", claim.hardware);
  }
}

Judged without_rows(const Claim& claim) {
  Judged judged;
  judged.claim = claim;
  judged.no_rows = claim.untestable.empty();
  judged.reason = judged.no_rows ? fmt::format("there are no rows of the experiment {}",
                                               fmt::join(claim.experiments, " or "))
                                 : claim.untestable;
  return judged;
}

}  // namespace

std::vector<Judged> judge(const ClaimFile& file, const std::vector<FoundRow>& rows) {
  std::map<std::pair<std::string, std::string>, std::map<std::string, std::vector<const Row*>>>
      by_machine;  // device and host -> experiment -> rows
  for (const FoundRow& found : rows)
    by_machine[{found.row.device, provenance_text(found.row, "host")}][found.row.experiment].push_back(
        &found.row);
  std::vector<Judged> result;
  for (const Claim& claim : file.claims) {
    const std::size_t before = result.size();
    for (const auto& [machine, experiments] : by_machine) {
      std::vector<const Row*> own;
      for (const std::string& name :
           std::set<std::string>(claim.experiments.begin(), claim.experiments.end()))
        if (const auto found = experiments.find(name); found != experiments.end())
          own.insert(own.end(), found->second.begin(), found->second.end());
      if (own.empty()) continue;
      Judged& judged = result.emplace_back();
      judged.claim = claim;
      judged.device = machine.first;
      judged.host = machine.second;
      judge_rows(file, judged, own);
    }
    if (result.size() == before) result.push_back(without_rows(claim));
  }
  return result;
}

}  // namespace pelage::claims
