// pelage report: reads journal files of recorded results and writes tables, plots and an HTML page.
#include "harness/report/report.hpp"

#include <fmt/format.h>

#include "harness/claims/print.hpp"
#include "harness/commands/commands.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/mesh/models.hpp"
#include "harness/page/page.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

struct ReportOptions {
  std::vector<std::string> results, views;
  std::string output;
};

/// Replaces the view (table [report] of the experiment file) in the rows of an experiment by the view in
/// `file`. Throws InputError if no row belongs to the experiment in `file`.
void use_view(std::vector<FoundRow>& rows, const std::string& file) {
  const Experiment experiment = read_experiment(experiment_file(file));
  bool any = false;
  for (FoundRow& found : rows) {
    if (found.row.experiment != experiment.name) continue;
    found.row.provenance["view"] = to_json(experiment.view);
    any = true;
  }
  if (!any)
    throw InputError(fmt::format("--view {}: no row belongs to the experiment {}", file, experiment.name));
}

/// Prints the testable claims and their verdicts, and the number of the untestable claims.
void print_judged(std::vector<claims::Judged> claims) {
  const std::size_t untestable = std::erase_if(
      claims, [](const claims::Judged& one) { return one.verdict == claims::Verdict::untestable; });
  if (!claims.empty()) fmt::print("{}", claims::text_of(claims));
  if (untestable > 0)
    fmt::print("{} {}claims are untestable with these rows; tables/claims.csv gives the reasons\n",
               untestable, claims.empty() ? "" : "further ");
}

void print_report(const Report& written) {
  for (const Section& section : written.sections) fmt::print("{}\n", text_of(section.table));
  print_judged(written.claims);
  fmt::print("{}", written.scaling);
  for (const std::string& note : written.notes) fmt::print(stderr, "pelage: {}\n", note);
  for (const Cell& cell : written.cells)
    if (cell.status != Status::ok)
      fmt::print(stderr, "pelage: {} {}: {}: {}\n", cell.experiment, cell.case_name, to_text(cell.status),
                 cell.reason);
}

int report(const ReportOptions& options) {
  Results results = read_all_results(options.results);
  for (LeftOut& one : missing_cases(journals_of(options.results), results.rows))
    results.left_out.push_back(std::move(one));
  for (const std::string& view : options.views) use_view(results.rows, view);
  const std::vector<Model> known = models();
  const auto footnote = [&known](const std::string& name) {
    for (const Model& model : known)
      if (model.name == name) return model.footnote;
    return std::string{};
  };
  const std::vector<Report> reports = write_reports(results.rows, options.output, footnote, results.left_out);
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
  command.add_option("results", options.results, "Folders with results, or journal files")
      ->required()
      ->type_name("RESULTS");
  command.add_option("-o,--output", options.output, "Folder of the report")->required()->type_name("DIR");
  command
      .add_option(
          "--view", options.views,
          "Experiment file whose table [report] replaces the one that the rows of this experiment recorded; may be given several times")
      ->allow_extra_args(false)
      ->type_name("FILE");
}

}  // namespace pelage
