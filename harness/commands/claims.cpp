// pelage claims: reads recorded results and prints whether they support the claims of papers or of the user.
#include <fmt/format.h>

#include "harness/atomic_file.hpp"
#include "harness/claims/claim.hpp"
#include "harness/claims/print.hpp"
#include "harness/commands/commands.hpp"
#include "harness/report/input_sets.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

struct ClaimsOptions {
  std::vector<std::string> results;
  std::string file, csv;
  bool json = false, markdown = false, all = false;
};

int print_claims(const ClaimsOptions& options) {
  const claims::ClaimFile file = claims::read_claims(
      options.file.empty() ? claims::shipped_claims() : std::filesystem::path(options.file));
  const std::vector<InputSet> sets = input_sets(read_results(options.results));
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
  command.add_option("results", options.results, "Folders with results, or journal files")
      ->required()
      ->type_name("RESULTS");
  command.add_option("--claims", options.file, "File of claims to use instead of experiments/claims.toml")
      ->type_name("FILE");
  command.add_option("--csv", options.csv, "Also write the claims as CSV; - prints only the CSV")
      ->type_name("FILE");
  auto* json = command.add_flag("--json", options.json, "Print JSON");
  command.add_flag("--all", options.all,
                   "Also print each claim about experiments that are not among the results");
  command.add_flag("--markdown", options.markdown, "Print a table for a Markdown document")->excludes(json);
}

}  // namespace pelage
