// Rows of results with synthetic times. The cases are those of the experiment silva2010-table1.
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "harness/experiment/experiment.hpp"
#include "harness/record/results_folder.hpp"
#include "harness/report/sections.hpp"

namespace pelage::test {

/// Returns one row without samples for every case of a shipped experiment and preset.
inline std::vector<FoundRow> bare_rows(const std::string& experiment, const std::string& preset,
                                       const std::string& device = "test device") {
  const Experiment e =
      read_experiment(std::filesystem::path(PELAGE_SOURCE_DIR) / "experiments" / (experiment + ".toml"));
  std::vector<FoundRow> rows;
  for (const Case& c : cases_of(e, preset_of(e, preset))) {
    Row row;
    row.experiment = e.name;
    row.case_name = c.name;
    row.variant = c.variant;
    row.axes = c.axes;
    row.device = device;
    row.provenance = {{"host", "h"}, {"converged", true}};
    rows.push_back({row, "results/" + experiment + "/test_device@h.jsonl"});
  }
  return rows;
}

/// Returns one row for each of the 32 cases, with 21 frame times that do not drift. Their median is factor *
/// (F + P) * N / 1e6 ms (an invented formula) with F triangles, P pixels and N layers, from which they differ
/// by at most 1%.
inline std::vector<FoundRow> table1_rows(double factor = 1, const std::string& device = "test device") {
  const Experiment e =
      read_experiment(std::filesystem::path(PELAGE_SOURCE_DIR) / "experiments/silva2010-table1.toml");
  const std::vector<Case> cases = cases_of(e, preset_of(e, "quick"));
  const std::map<std::string, double> triangles{{"torus", 9360},      {"pear", 20845},  {"hippo", 44452},
                                                {"cow", 92689},       {"horse", 95533}, {"bunny", 142307},
                                                {"elephant", 154789}, {"lion", 365118}};
  std::vector<FoundRow> rows = bare_rows(e.name, "quick", device);
  for (std::size_t c = 0; c < rows.size(); ++c) {
    Row& row = rows[c].row;
    row.run_id = "run";
    const double count = triangles.at(row.axes.at("model")), layers = std::stod(row.axes.at("layers"));
    const double pixels = row.axes.at("size") == "800x600" ? 480000 : 1764000;
    const double ms = factor * (count + pixels) * layers / 1e6;
    for (int i = 0; i < 21; ++i) row.samples["frame"].wall_ms.push_back(ms * (1 + 0.001 * (8 * i % 21 - 10)));
    row.samples["raster"].event_ms = row.samples["frame"].wall_ms;
    row.metrics["triangles"] = {count, "triangles"};
    row.metrics["covered_fragments"] = {pixels * layers / 3, "fragments"};
    row.metrics["paper_fps"] = *cases[c].published;
    row.provenance["utc"] = "2026-11-21T00:00:00Z";
    row.provenance["preset"] = "quick";
  }
  return rows;
}

/// Returns one row for each combination of the axes' values. The median of the first row is 10 ms, that of
/// the second row is 20 ms, and so on.
inline std::vector<FoundRow> own_rows(const std::vector<Axis>& axes) {
  std::vector<FoundRow> rows(1);
  for (const Axis& axis : axes) {
    std::vector<FoundRow> more;
    for (const FoundRow& row : rows)
      for (const std::string& v : axis.values) {
        more.push_back(row);
        more.back().row.axes[axis.key] = v;
        more.back().row.case_name += "-" + v;
      }
    rows = more;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Row& row = rows[i].row;
    row.run_id = "run";
    row.experiment = "own";
    row.variant = row.axes.contains("variant") ? row.axes["variant"] : "shells/tile";
    row.device = "test device";
    row.samples["frame"].wall_ms.assign(11, 10.0 * double(i + 1));
    row.provenance = {{"host", "h"}, {"converged", true}};
    rows[i].journal = "results/own/test_device@h.jsonl";
  }
  return rows;
}

inline std::string note_of_hippo(const std::string& model) {
  return model == "hippo" ? "stand-in: a pig & 100% so" : "";
}

inline std::vector<Section> sections(const std::vector<FoundRow>& rows,
                                     std::vector<std::string>* notes = nullptr) {
  std::vector<std::string> own;
  return sections_of(cells_of(rows), {note_of_hippo, false, false, notes ? notes : &own});
}

}  // namespace pelage::test
