// pelage compare: finds the cases that became slower or faster between two sets of results.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "harness/atomic_file.hpp"
#include "harness/commands/commands.hpp"
#include "harness/error.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/record/device_settings.hpp"
#include "harness/report/comparison.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

struct CompareOptions {
  std::string a, b, by, phase = "frame", threshold = "5%", alpha = "5%";
  std::string latex, plot;
  bool fail_on_regression = false, json = false;
};

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

void print_pairs(const std::vector<Pair>& pairs, const Table& table, const CompareOptions& options) {
  if (options.json) {
    auto list = nlohmann::ordered_json::array();
    for (const Pair& p : pairs) list.push_back(pair_json(p));
    fmt::print("{}\n", list.dump(2));
    return;
  }
  fmt::print("{}", text_of(table));
  for (const Pair& p : pairs)
    if (!p.reason.empty()) fmt::print("{}: {}\n", p.name, p.reason);
}

/// Writes the table as CSV and its plot as SVG and PDF beside `output`, which ends in .svg or .pdf.
void draw(const Table& table, const std::filesystem::path& output) {
  const std::filesystem::path stem = std::filesystem::path(output).replace_extension();
  const auto with = [&](const char* ending) { return std::filesystem::path(stem) += ending; };
  write_text_atomically(with(".csv"), csv_of(table));
  write_text_atomically(with(".json"), json_of(comparison_plot(table)));
  const std::string problem = draw_plot(plot_program("plot"), with(".csv"), stem);
  if (!problem.empty()) throw InputError(fmt::format("{}: {}", output.string(), problem));
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
  std::vector<FoundRow> rows = read_results({folder});
  add_settings_as_axes(rows);
  std::vector<Cell> cells = cells_of(rows);
  if (phase != "frame") use_phase(cells, rows, phase);
  return cells;
}

int compare(const CompareOptions& options) {
  const std::string ending = std::filesystem::path(options.plot).extension().string();
  if (!options.plot.empty() && ending != ".svg" && ending != ".pdf")
    throw InputError(fmt::format("--plot {}: the name must end in .svg or .pdf", options.plot));
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
  // The last part of the path names a set of results.
  const auto name = [](const std::string& path, const char* otherwise) {
    const std::string last = std::filesystem::weakly_canonical(path).filename().string();
    return path.empty() || last.empty() ? otherwise : last;
  };
  const Table table = one_set ? comparison_table(pairs, by)
                              : comparison_table(pairs, by, name(options.a, "A"), name(options.b, "B"));
  print_pairs(pairs, table, options);
  if (!options.latex.empty()) write_text_atomically(options.latex, latex_of(table));
  if (!options.plot.empty()) draw(table, options.plot);
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
  add_value(command, "--latex", options.latex, "FILE.tex", "Also write the table as LaTeX");
  add_value(command, "--plot", options.plot, "FILE.svg|FILE.pdf",
            "Also draw the changes; writes FILE.svg, FILE.pdf and the table FILE.csv");
}

}  // namespace pelage
