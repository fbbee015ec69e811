// Tests that the recorded rows (results/) still give the recorded tables (results/tables), which the
// documents cite. scripts/record_all.sh writes both.
#include <toml++/toml.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "harness/claims/print.hpp"
#include "harness/report/csv.hpp"
#include "harness/report/report.hpp"
#include "harness/table/render.hpp"
#include "tests/report/rows.hpp"
#include "tests/support/files.hpp"

namespace pelage {
namespace {

const fs::path results = fs::path(PELAGE_SOURCE_DIR) / "results";

/// A folder of results/tables, and how the names of the folders of its rows in results/ begin.
struct Recorded {
  std::string tables;
  std::vector<std::string> rows;
  std::size_t files;  ///< number of compared files
  /// Files that are not compared: they name the journals in another order or metrics by old names.
  std::set<std::string> except = {};
};

std::map<std::string, std::string> files_of(const std::vector<FoundRow>& rows) {
  std::map<std::string, std::string> files;
  const std::vector<Cell> cells = cells_of(rows);
  const toml::table file = toml::parse_file((results.parent_path() / "experiments/models.toml").string());
  std::map<std::string, std::string> notes;
  std::vector<std::string> said;
  for (const toml::node& model : *file["model"].as_array())
    notes[model.at_path("name").value_or("")] = model.at_path("footnote").value_or("");
  std::vector<Section> sections =
      sections_of(cells, {[&](const std::string& model) { return notes[model]; }, false, false, &said});
  std::vector<fs::path> journals;
  for (const FoundRow& found : rows)
    if (std::ranges::count(journals, found.journal) == 0) journals.emplace_back(found.journal);
  std::vector<LeftOut> left_out = missing_cases(journals, rows);
  std::ranges::move(without_numbers(cells, rows), std::back_inserter(left_out));
  if (!left_out.empty()) sections.push_back(left_out_section(left_out));
  for (const Section& section : sections) {
    files[section.table.stem + ".csv"] = csv_of(section.table);
    files[section.table.stem + ".txt"] = text_of(section.table);
    files[section.table.stem + ".tex"] = latex_of(section.table);
    for (const PlotSpec& plot : section.plots) files[plot.stem + ".json"] = json_of(plot);
  }
  const Table solvers = solver_table(rows);
  files[solvers.stem + ".csv"] = csv_of(solvers);
  files["layers-ratios.csv"] = in_turns_csv(in_turns_cells(cells));
  files["provenance.txt"] = std::regex_replace(provenance_of(rows), std::regex(" \n"), "\n");
  auto verdicts = claims::judge(claims::read_claims(claims::shipped_claims()), rows);
  std::erase_if(verdicts, [](const claims::Judged& judged) { return judged.device.empty(); });
  files["claims.csv"] = csv_lines(claims::table_of(verdicts));
  return files;
}

TEST(RecordedRows, StillGiveTheRecordedTables) {
  const std::vector<Recorded> all = {
      {"table1", {"silva2010-table1"}, 7},
      {"wet", {"wetfur2010-"}, 8},
      {"topology", {"banisch2006-", "topology-"}, 47},
      {"rivals", {"rival"}, 10},
      {"xeon", {"xeon"}, 16},
      {"rivals-avx2", {"avx2"}, 4},
      {"effects", {"overheads", "readings", "silva2010-self-shadow"}, 9, {"provenance.txt"}},
      {"strands", {"demoreuille2011-", "strands-opengl-ways"}, 16},
      {"scaling", {"layers", "scaling"}, 6, {"provenance.txt"}}};
  for (const Recorded& recorded : all) {
    std::set<std::string> places;
    for (const auto& place : fs::directory_iterator(results))
      for (const std::string& begin : recorded.rows)
        if (place.path().filename().string().starts_with(begin)) places.insert(place.path().string());
    const auto files = files_of(read_results({places.begin(), places.end()}));
    std::size_t compared = 0;
    for (const auto& file : fs::directory_iterator(results / "tables" / recorded.tables)) {
      const auto found = files.find(file.path().filename().string());
      if (found == files.end() || recorded.except.contains(found->first)) continue;
      ++compared;
      EXPECT_EQ(found->second, test::text_of(file.path())) << file.path();
    }
    EXPECT_EQ(compared, recorded.files) << recorded.tables;
  }
  const Report report =
      write_report(read_results({results / "scaling"}), test::Folder().path, test::note_of_hippo);
  std::set<std::string> names;
  for (const auto& [name, text] : report.files) EXPECT_TRUE(names.insert(name).second) << name;
}

}  // namespace
}  // namespace pelage
