// pelage export: reads journal files of recorded results and writes them as CSV.
#include "harness/commands/export.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "harness/atomic_file.hpp"
#include "harness/report/csv.hpp"

namespace pelage {
namespace {

struct ExportOptions {
  std::vector<std::string> results;
  std::string csv = "-";
  bool raw = false;
};

int export_csv(const ExportOptions& options) {
  const std::vector<FoundRow> rows = read_results(options.results);
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
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "Write recorded results as CSV");
  command->add_option("results", options->results, "Folders with results, or journal files")
      ->required()
      ->type_name("RESULTS");
  command->add_option("--csv", options->csv, "Output file; - is standard output")
      ->type_name("FILE")
      ->capture_default_str();
  command->add_flag("--raw", options->raw,
                    "Write one line per sample instead of one line per case and phase");
  command->callback([options, &chosen] { chosen = [options] { return export_csv(*options); }; });
}

}  // namespace pelage
