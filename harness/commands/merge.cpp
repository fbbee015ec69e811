// pelage merge: writes the rows of several folders of results into one folder, and prints which shards and
// cases are missing. A shard is a part of a run that a separate process measures.
#include "harness/record/merge.hpp"

#include <fmt/format.h>

#include "harness/commands/commands.hpp"
#include "harness/commands/run_options.hpp"
#include "harness/error.hpp"
#include "harness/record/shards.hpp"

namespace pelage {
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
  command.add_option("output", options.output, "New folder for the merged results")
      ->required()
      ->type_name("OUT");
  command.add_option("results", options.results, "Folders with results, or journal files")
      ->required()
      ->type_name("RESULTS");
  command.add_flag(
      "--keep-apart", options.keep_apart,
      "Write rows that conflict with other rows into separate folders apart-2, apart-3, ... in OUT, instead of refusing them");
  command.add_flag("--dry-run", options.dry_run, "Print missing shards and cases, and write nothing");
  CLI::Option* expect =
      command
          .add_option(
              "--expect", options.expect,
              "Also print the cases of this experiment that were not measured; the next options select its cases, as in pelage run")
          ->allow_extra_args(false)
          ->type_name("EXPERIMENT|FILE.toml");
  declare_cases(command, options.expected);
  for (const char* name : {"--preset", "--model", "--up", "--set", "--axis", "--filter"})
    command.get_option(name)->needs(expect);
}

}  // namespace pelage
