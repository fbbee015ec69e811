#include "harness/claims/verdict.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace pelage::claims {
namespace {

constexpr double significance = 0.05;

double quantile_of_sorted(const std::vector<double>& values, double q) {
  const double position = q * double(values.size() - 1);
  const auto below = std::size_t(position);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (position - double(below)) * (values[above] - values[below]);
}

struct Sorted {
  std::vector<double> draws;  // in increasing order
  // Two-sided bootstrap p-value. The null hypothesis contradicts the measurement: if the measured effect is
  // inside the region, the null hypothesis says that the true effect is outside, and vice versa.
  double p = 1;
};

Sorted sorted_of(const Estimate& estimate, const Region& region) {
  Sorted result{estimate.draws, 1};
  std::sort(result.draws.begin(), result.draws.end());
  const bool inside = region.contains(estimate.value);
  const auto opposite = std::count_if(result.draws.begin(), result.draws.end(),
                                      [&](double draw) { return region.contains(draw) != inside; });
  result.p = std::min(1.0, 2 * double(opposite + 1) / double(result.draws.size() + 1));
  return result;
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

int draws_for(std::size_t effects) {
  return int(std::max<std::size_t>(2000, 100 * effects));
}

Decision decide(const std::vector<Estimate>& estimates, const Region& region) {
  const std::size_t count = estimates.size();
  std::vector<Sorted> sorted;
  sorted.reserve(count);
  for (const Estimate& estimate : estimates) sorted.push_back(sorted_of(estimate, region));
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sorted[a].p < sorted[b].p; });

  std::vector<Verdict> found(count, Verdict::undecided);
  std::vector<Decision> each(count);
  bool stopped = false;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = order[k];
    const double rest = significance / double(count - k);
    each[i].decisive = i;
    each[i].confidence = 1 - rest;
    each[i].interval = {quantile_of_sorted(sorted[i].draws, rest / 2),
                        quantile_of_sorted(sorted[i].draws, 1 - rest / 2)};
    if (stopped) continue;
    const auto [low, high] = each[i].interval;
    if (region.contains(low, high))
      found[i] = Verdict::holds;
    else if (region.outside(low, high))
      found[i] = Verdict::fails;
    else
      stopped = true;
  }
  Verdict verdict = Verdict::holds;
  for (const Verdict one : found) {
    if (one == Verdict::fails) verdict = Verdict::fails;
    if (one == Verdict::undecided && verdict == Verdict::holds) verdict = Verdict::undecided;
  }
  std::size_t decisive = count;
  for (std::size_t i = 0; i < count; ++i)
    if (found[i] == verdict &&
        (decisive == count || margin(region, estimates[i].value) < margin(region, estimates[decisive].value)))
      decisive = i;
  Decision decision = each[decisive];
  decision.verdict = verdict;
  return decision;
}

}  // namespace pelage::claims
