// pelage compare: finds the cases that became slower or faster between two sets of results.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/commands/commands.hpp"
#include "harness/error.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/report/comparison.hpp"

namespace pelage {
namespace {

struct CompareOptions {
  std::string a, b, by, phase = "frame", threshold = "5%", alpha = "5%";
  bool fail_on_regression = false, json = false;
};

std::string milliseconds(double value) {
  return value > 0 ? fmt::format("{:.3f}", value) : "-";
}

std::string percent(double fraction) {
  return fmt::format("{:+.1f}%", 100 * fraction);
}

nlohmann::ordered_json pair_json(const Pair& p) {
  return {{"case", p.name},
          {"a", p.a},
          {"b", p.b},
          {"a_ms", p.a_ms},
          {"b_ms", p.b_ms},
          {"a_processes", p.a_processes},
          {"b_processes", p.b_processes},
          {"change", p.change},
          {"low", p.interval.low},
          {"high", p.interval.high},
          {"confidence", p.confidence},
          {"p", p.p},
          {"paired", p.paired},
          {"assumed_spread", p.assumed},
          {"detectable", p.detectable},
          {"processes_needed", p.needed},
          {"contended", p.contended},
          {"verdict", to_text(p.verdict)},
          {"reason", p.reason}};
}

void print_pairs(const std::vector<Pair>& pairs, const CompareOptions& options) {
  if (options.json) {
    auto list = nlohmann::ordered_json::array();
    for (const Pair& p : pairs) list.push_back(pair_json(p));
    fmt::print("{}\n", list.dump(2));
    return;
  }
  fmt::print("{:>10} {:>10} {:>8}  {:<18} {:9} case\n", "A, ms", "B, ms", "change", "interval", "verdict");
  for (const Pair& p : pairs) {
    const bool both = p.a_ms > 0 && p.b_ms > 0;
    fmt::print("{:>10} {:>10} {:>8}  {:<18} {:9} {}{}{}{}\n", milliseconds(p.a_ms), milliseconds(p.b_ms),
               both ? percent(p.change) : "-",
               both ? fmt::format("[{}, {}]", percent(p.interval.low), percent(p.interval.high)) : "",
               to_text(p.verdict), p.name, options.by.empty() ? "" : fmt::format("  ({} -> {})", p.a, p.b),
               p.contended ? "  (contended)" : "", p.reason.empty() ? "" : fmt::format("  ({})", p.reason));
  }
}

/// Prints notes below the table:
/// - how many comparisons are paired;
/// - how many comparisons assume a variance, because too few processes measured a case;
/// - how many comparisons used times from a loaded machine;
/// - the slowdown that the test would find with a probability of 90% in every undecided case;
/// - the number of processes that would decide the undecided cases.
void print_notes(const std::vector<Pair>& pairs) {
  const auto count = [&](auto which) { return std::count_if(pairs.begin(), pairs.end(), which); };
  if (const auto paired = count([](const Pair& p) { return p.paired; }))
    fmt::print(
        stderr,
        "pelage: paired t-test for {} of {} comparisons, because the processes of A and B took turns\n",
        paired, pairs.size());
  if (const auto assumed = count([](const Pair& p) { return p.assumed; }))
    fmt::print(
        stderr,
        "pelage: {} of {} comparisons assume that the medians of processes vary by {:.0f}% (standard deviation), because fewer than {} processes measured a case; run the experiments with --repeat 5\n",
        assumed, pairs.size(), 100 * assumed_spread, fewest_processes);
  if (const auto contended = count([](const Pair& p) { return p.contended; }))
    fmt::print(
        stderr,
        "pelage: {} of {} comparisons contain rows that were timed while other processes used more than {:.0f}% of the machine's CPU time; these verdicts are about the loaded machine\n",
        contended, pairs.size(), 100 * most_other_share);
  double most = 0;
  std::size_t needed = 0, undecided = 0, more = 0;
  for (const Pair& p : pairs) {
    if (p.verdict != Verdict::undecided) continue;
    most = std::max(most, p.detectable);
    if (p.assumed) continue;
    ++undecided;
    needed = std::max(needed, p.needed);
    more += p.needed == 0;
  }
  if (most > 0)
    fmt::print(
        stderr,
        "pelage: in the worst undecided case, the test finds a slowdown with a probability of 90% only if the time increases by {} or more\n",
        percent(most));
  if (undecided > more)
    fmt::print(
        stderr,
        "pelage: if the measured changes are the true ones, about {} processes per side (--repeat {}) would decide {} of the {} undecided cases\n",
        needed, needed, undecided - more, undecided);
  if (more > 0)
    fmt::print(
        stderr,
        "pelage: {} changes are so close to the threshold that even 1000 processes per side would not decide; use another --threshold\n",
        more);
}

std::vector<Cell> timed_cells(const std::string& folder, const std::string& phase) {
  const std::vector<FoundRow> rows = read_results({folder});
  std::vector<Cell> cells = cells_of(rows);
  if (phase != "frame") use_phase(cells, rows, phase);
  return cells;
}

int compare(const CompareOptions& options) {
  const CompareBy by(options.by);
  const CompareLimits limits{fraction_from_text("--threshold", options.threshold),
                             fraction_from_text("--alpha", options.alpha)};
  if (!(limits.alpha > 0 && limits.alpha < 0.5))
    throw InputError(
        fmt::format("--alpha '{}' must be above 0 and below 50%; write for instance 5%", options.alpha));
  const bool one_set = options.b.empty();
  if (one_set && by.text.empty())
    throw InputError(
        "give two sets of results (A and B), or one set with --by device, --by variant or --by axes.KEY");
  const std::vector<Cell> a = timed_cells(options.a, options.phase);
  const std::vector<Cell> b = one_set ? std::vector<Cell>() : timed_cells(options.b, options.phase);
  const std::vector<Pair> pairs = compare_cells(a, b, one_set, by, limits);
  print_pairs(pairs, options);
  const auto count = [&](Verdict v) {
    return std::count_if(pairs.begin(), pairs.end(), [v](const Pair& p) { return p.verdict == v; });
  };
  fmt::print(
      stderr,
      "pelage: {} faster, {} slower, {} same, {} undecided, {} without a time in B (threshold {}; probability of any wrong verdict at most {})\n",
      count(Verdict::faster), count(Verdict::slower), count(Verdict::same), count(Verdict::undecided),
      count(Verdict::lost), options.threshold, options.alpha);
  print_notes(pairs);
  return options.fail_on_regression && count(Verdict::slower) + count(Verdict::lost) > 0 ? 5 : 0;
}

}  // namespace

void add_compare(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<CompareOptions>(app, chosen, "compare",
                                                        "Compare two sets of results, case by case", compare);
  add_value(command, "a", options.a, "A", "First set of results")->required();
  add_value(command, "b", options.b, "B",
            "Second set of results; without it, --by compares results of A with each other");
  add_value(command, "--by", options.by, "device|variant|axes.KEY",
            "Property in which the two results of a comparison may differ");
  add_value(command, "--phase", options.phase, "PHASE",
            "Phase whose times are compared, such as simulate or raster; frame: the time of the whole frame");
  add_value(command, "--threshold", options.threshold, "5%",
            "Largest relative change of a time that counts as no change");
  add_value(command, "--alpha", options.alpha, "5%",
            "Largest probability that one or more of the verdicts are wrong (Holm's correction)");
  command.add_flag("--fail-on-regression", options.fail_on_regression,
                   "Exit with code 5 if a case is slower in B or has no time in B");
  command.add_flag("--json", options.json, "Print JSON");
}

}  // namespace pelage
