// The commands that read journal files of recorded results: pelage export, claims, report and merge.
#include <fmt/format.h>

#include <algorithm>

#include "harness/atomic_file.hpp"
#include "harness/claims/claim.hpp"
#include "harness/claims/print.hpp"
#include "harness/commands/commands.hpp"
#include "harness/commands/run_options.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/mesh/models.hpp"
#include "harness/page/page.hpp"
#include "harness/record/device_settings.hpp"
#include "harness/record/merge.hpp"
#include "harness/record/results_folder.hpp"
#include "harness/record/shards.hpp"
#include "harness/report/csv.hpp"
#include "harness/report/report.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

struct ExportOptions {
  std::vector<std::string> results;
  std::string csv = "-";
  bool raw = false;
};

/// Prints which rows and lines of the journals are not in the CSV. Prints at most ten of these rows and
/// lines, and then the number of the remaining ones.
void note_left_out(const std::vector<LeftOut>& list) {
  constexpr std::size_t most = 10;
  for (std::size_t i = 0; i < std::min(list.size(), most); ++i)
    fmt::print(stderr, "pelage: left out: {}{}{}: {}\n", list[i].where, list[i].case_name.empty() ? "" : ": ",
               list[i].case_name, list[i].reason);
  if (list.size() > most)
    fmt::print(stderr, "pelage: left out: {} more rows or lines of the journals\n", list.size() - most);
}

int export_csv(const ExportOptions& options) {
  Results results = read_all_results(options.results);
  add_settings_as_axes(results.rows);
  const std::vector<FoundRow>& rows = results.rows;
  note_left_out(results.left_out);
  const std::string text = options.raw ? csv_by_sample(rows) : csv_by_phase(rows);
  if (options.csv == "-") {
    fmt::print("{}", text);
    return 0;
  }
  write_text_atomically(options.csv, text);
  return 0;
}

}  // namespace

void add_export(CLI::App& app, Chosen& chosen) {
  auto [command, options] =
      add_command<ExportOptions>(app, chosen, "export", "Write recorded results as CSV", export_csv);
  add_results_option(command, options.results);
  add_value(command, "--csv", options.csv, "FILE", "Output file; - is standard output");
  command.add_flag("--raw", options.raw, "Write one line per sample instead of one line per case and phase");
}

namespace {

struct ClaimsOptions {
  std::vector<std::string> results;
  std::string file, csv;
  bool json = false, markdown = false, all = false;
};

int print_claims(const ClaimsOptions& options) {
  const claims::ClaimFile file = claims::read_claims(
      options.file.empty() ? claims::shipped_claims() : std::filesystem::path(options.file));
  std::vector<FoundRow> rows = read_results(options.results);
  add_settings_as_axes(rows);
  const std::vector<InputSet> sets = input_sets(rows);
  const std::vector<claims::Judged> judged = claims::judge(file, sets.front().rows);
  for (std::size_t i = 1; i < sets.size(); ++i)
    fmt::print(
        stderr,
        "pelage: {} rows are not used: they have the same experiment and case names as other rows, but measured different inputs ({}). To judge the claims by these rows, give only their journals\n",
        sets[i].rows.size(), sets[i].differs);
  if (options.csv == "-")
    fmt::print("{}", csv_lines(claims::table_of(judged)));
  else if (!options.csv.empty())
    write_text_atomically(options.csv, csv_lines(claims::table_of(judged)));
  if (options.csv == "-") return 0;
  if (options.json)
    fmt::print("{}\n", claims::json_of(judged).dump(2));
  else
    fmt::print("{}", options.markdown ? claims::markdown_of(judged) : claims::text_of(judged, options.all));
  return 0;
}

}  // namespace

void add_claims(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<ClaimsOptions>(
      app, chosen, "claims", "Print which claims of the papers hold for recorded results", print_claims);
  add_results_option(command, options.results);
  add_value(command, "--claims", options.file, "FILE",
            "File of claims to use instead of experiments/claims.toml");
  add_value(command, "--csv", options.csv, "FILE", "Also write the claims as CSV; - prints only the CSV");
  auto* json = command.add_flag("--json", options.json, "Print JSON");
  command.add_flag("--all", options.all,
                   "Also print each claim about experiments that are not among the results");
  command.add_flag("--markdown", options.markdown, "Print a table for a Markdown document")->excludes(json);
}

namespace {

struct ReportOptions {
  std::vector<std::string> results, views;
  std::string output, claims;
};

/// Replaces the view (table [report] of the experiment file) in the rows of an experiment by the view in
/// `file`. Throws InputError if no row belongs to the experiment in `file`.
void use_view(std::vector<FoundRow>& rows, const std::string& file) {
  const auto [name, view] = read_view_of(experiment_file(file));
  bool any = false;
  for (FoundRow& found : rows) {
    if (found.row.experiment != name) continue;
    found.row.provenance["view"] = to_json(view);
    any = true;
  }
  if (!any) throw InputError(fmt::format("--view {}: no row belongs to the experiment {}", file, name));
}

/// Prints the testable claims and their verdicts, and the number of the untestable claims.
void print_judged(std::vector<claims::Judged> claims) {
  const std::size_t untestable = std::erase_if(
      claims, [](const claims::Judged& one) { return one.verdict == claims::Verdict::untestable; });
  if (!claims.empty()) fmt::print("{}", claims::text_of(claims, true));
  if (untestable > 0)
    fmt::print("{} {}claims are untestable with these rows; tables/claims.csv gives the reasons\n",
               untestable, claims.empty() ? "" : "further ");
}

void print_report(const Report& written) {
  for (const Section& section : written.sections) fmt::print("{}\n", text_of(section.table));
  print_judged(written.claims);
  fmt::print("{}", written.scaling);
  for (const std::string& note : written.notes) fmt::print(stderr, "pelage: {}\n", note);
}

int report(const ReportOptions& options) {
  std::optional<claims::ClaimFile> claims;
  if (!options.claims.empty()) claims = claims::read_claims(options.claims);
  Results results = read_all_results(options.results);
  for (LeftOut& one : missing_cases(journals_of(options.results), results.rows))
    results.left_out.push_back(std::move(one));
  add_settings_as_axes(results.rows);
  for (const std::string& view : options.views) use_view(results.rows, view);
  const std::vector<Report> reports =
      write_reports(results.rows, options.output, footnote_of, results.left_out, claims);
  for (const Report& written : reports) print_report(written);
  const std::filesystem::path page = std::filesystem::path(options.output) / "index.html";
  for (const std::string& note : write_page(reports, page)) fmt::print(stderr, "pelage: {}\n", note);
  fmt::print(stderr, "pelage: wrote the report to {}\n", page.string());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<ReportOptions>(
      app, chosen, "report",
      "Write tables, plots and a page from results; the page is one HTML file that needs no network", report);
  add_results_option(command, options.results);
  add_value(command, "-o,--output", options.output, "DIR", "Folder of the report")->required();
  add_value(
      command, "--view", options.views, "FILE",
      "Experiment file whose table [report] replaces the one that the rows of this experiment recorded; may be given several times")
      ->allow_extra_args(false);
  add_value(command, "--claims", options.claims, "FILE",
            "File of claims to judge instead of experiments/claims.toml");
}

namespace {

/// Exit code of pelage merge if shards or cases are missing.
constexpr int missing_code = 4;

struct MergeOptions {
  std::string output;
  std::vector<std::string> results, expect;
  RunOptions expected;  ///< options such as --filter, which select the expected cases
  bool keep_apart = false, dry_run = false;
};

/// Returns one line of text for each expected case that has no row, or only rows with the status `error`.
std::vector<std::string> missing_cases(const MergeOptions& options, const std::vector<RunState>& states) {
  std::vector<std::string> lines;
  for (const std::string& name : options.expect) {
    const Experiment experiment = read_experiment(experiment_file(name));
    const std::vector<Case> cases = chosen_cases(experiment, options.expected.preset, options.expected.filter,
                                                 options.expected.overrides());
    bool any = false;
    for (const RunState& state : states) {
      if (state.experiment != experiment.name || state.overrides != cases.front().overrides) continue;
      any = true;
      for (const Case& which : cases)
        if (!state.done.contains(which.name))
          lines.push_back(fmt::format("{}\t{}\tcase {}: {}", experiment.name, state.where, which.name,
                                      state.failed.contains(which.name) ? "ended with an error" : "no row"));
    }
    if (!any)
      for (const Case& which : cases)
        lines.push_back(fmt::format("{}\t-\tcase {}: no row", experiment.name, which.name));
  }
  return lines;
}

std::vector<std::string> missing_shards(const std::vector<RunState>& states) {
  std::vector<std::string> lines;
  for (const RunState& state : states)
    for (const Gap& gap : state.gaps)
      lines.push_back(fmt::format("{}\t{}\t{}", state.experiment, state.where, text_of(gap)));
  return lines;
}

void note_deals(const std::vector<RunState>& states) {
  for (const RunState& state : states)
    if (state.dealt_differently)
      fmt::print(
          stderr,
          "pelage: warning: {} {}: the shards were started with different cases or with different --balance results, so that a case may belong to no shard\n",
          state.experiment, state.where);
}

void note_result(const MergeOptions& options, const Merge& merge, std::size_t pictures) {
  fmt::print(stderr, "pelage: {}{} rows{}{}{}\n",
             options.dry_run ? "would write " : fmt::format("{}: ", options.output), merge.rows.size(),
             options.dry_run ? "" : fmt::format(", {} pictures", pictures),
             merge.copies ? fmt::format("; {} copies of rows left out", merge.copies) : "",
             merge.replaced ? fmt::format("; {} rows with errors left out, because other rows replace them",
                                          merge.replaced)
                            : "");
  for (std::size_t i = 0; i < merge.apart.size(); ++i)
    fmt::print(stderr, "pelage: rows that differ ({}) are in {}/apart-{}\n", merge.apart[i], options.output,
               i + 2);
}

int merge_command(const MergeOptions& options) {
  refuse_recordings(options.output);
  if (!options.dry_run) require_new_folder(options.output);
  const std::vector<FoundRow> rows = read_results(options.results);
  if (rows.empty())
    throw InputError(fmt::format("{}: the journals contain no rows", options.results.front()));
  const Merge merge = plan_merge(rows, options.keep_apart);
  const std::vector<RunState> states = run_states(journals_of(options.results), rows);
  std::vector<std::string> missing = missing_shards(states);
  const std::vector<std::string> cases = missing_cases(options, states);
  missing.insert(missing.end(), cases.begin(), cases.end());

  note_result(options, merge, options.dry_run ? 0 : write_merge(merge, options.output));
  note_deals(states);
  for (const std::string& line : missing) fmt::print("{}\n", line);
  if (missing.empty()) return 0;
  fmt::print(stderr, "pelage: shards or cases are missing (see the lines on standard output)\n");
  return missing_code;
}

}  // namespace

void add_merge(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<MergeOptions>(
      app, chosen, "merge",
      "Merge the rows of shards and runs into one folder, and print missing shards and cases", merge_command);
  add_value(command, "output", options.output, "OUT", "New folder for the merged results")->required();
  add_results_option(command, options.results);
  command.add_flag(
      "--keep-apart", options.keep_apart,
      "Write rows that conflict with other rows into separate folders apart-2, apart-3, ... in OUT, instead of refusing them");
  command.add_flag("--dry-run", options.dry_run, "Print missing shards and cases, and write nothing");
  CLI::Option* expect =
      add_value(
          command, "--expect", options.expect, "EXPERIMENT|FILE.toml",
          "Also print the cases of this experiment that were not measured; the next options select its cases, as in pelage run")
          ->allow_extra_args(false);
  declare_cases(command, options.expected);
  for (const char* name : {"--preset", "--model", "--up", "--set", "--axis", "--filter"})
    command.get_option(name)->needs(expect);
}

}  // namespace pelage
