// pelage export: reads journal files of recorded results and writes them as CSV.
#include <fmt/format.h>

#include <algorithm>

#include "harness/atomic_file.hpp"
#include "harness/commands/commands.hpp"
#include "harness/record/results_folder.hpp"
#include "harness/report/csv.hpp"

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
  const Results results = read_all_results(options.results);
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
  command.add_option("results", options.results, "Folders with results, or journal files")
      ->required()
      ->type_name("RESULTS");
  command.add_option("--csv", options.csv, "Output file; - is standard output")
      ->type_name("FILE")
      ->capture_default_str();
  command.add_flag("--raw", options.raw, "Write one line per sample instead of one line per case and phase");
}

}  // namespace pelage
