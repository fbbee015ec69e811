#include "harness/report/report.hpp"

#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>

#include "harness/error.hpp"
#include "harness/report/csv.hpp"
#include "harness/report/plot_spec.hpp"
#include "tests/report/rows.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace test;

/// A Python script reads the two CSV files with the module csv. All lines of a file must have the same number
/// of columns, and the numbers must be those of `rows`.
TEST(Csv, PythonReadsIt) {
  const Folder folder;
  auto rows = table1_rows();
  rows[1].row.reason = "two\nlines, \"quoted\"";
  rows[2].row.status = Status::error;
  rows[3].row.samples["frame"].cpu_ms = {15.5, 16.5};
  folder.write("phases.csv", csv_by_phase(rows));
  folder.write("samples.csv", csv_by_sample(rows));
  folder.write("check.py", R"(
import csv, sys
phases = list(csv.DictReader(open(sys.argv[1], newline="")))
samples = list(csv.DictReader(open(sys.argv[2], newline="")))
assert all(None not in r and None not in r.values() for r in phases + samples)
assert len(phases) == 31 * 2 + 2, len(phases)
assert len(samples) == 31 * 42 + 2, len(samples)
assert [r["median_ms"] for r in phases if r["clock"] == "cpu"] == ["16"]
first = [r for r in phases if r["case"] == "torus-16-800x600" and r["phase"] == "frame"][0]
assert (first["clock"], first["samples"], first["contended"]) == ("wall", "21", "")
assert abs(float(first["median_ms"]) - 7.82976) < 1e-6, first["median_ms"]
assert (first["model"], first["layers"], first["size"]) == ("torus", "16", "800x600")
assert float(first["metric.paper_fps"]) == 267
assert any(r["reason"] == 'two\nlines, "quoted"' for r in phases)
assert [r["median_ms"] for r in phases if r["status"] == "error"] == [""]
)");
  const std::string command =
      fmt::format("python3 {0}/check.py {0}/phases.csv {0}/samples.csv", folder.path.string());
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(Report, WritesEverythingItPromises) {
  const Folder folder;
  auto rows = table1_rows();
  // The test stores a picture at the path to which pelage run would write the picture of this case.
  const fs::path journal = folder.path / "results" / "silva2010-table1" / "test_device@h.jsonl";
  fs::create_directories(journal.parent_path() / "images");
  std::ofstream(journal.parent_path() / "images" / "torus-64-800x600.png") << "png";
  for (FoundRow& row : rows) row.journal = journal;
  rows[0].row.provenance.erase("utc");  // as a stranger's program may write it
  rows[1].row.provenance["utc"] = "2026-11-20T00:00:00Z";

  const fs::path out = folder.path / "deep" / "report";
  const Report report = write_report(rows, out, note_of_hippo);
  for (const char* file : {"tables/silva2010-table1.csv", "tables/silva2010-table1.tex", "tables/claims.csv",
                           "tables/all-phases.csv", "references.bib", "provenance.txt",
                           "images/silva2010-table1-torus.png", "plots/silva2010-table1-frame-time.csv",
                           "plots/plot.py", "plots/style.py", "plots/silva2010-table1-frame-time.json"})
    EXPECT_TRUE(fs::is_regular_file(out / file)) << file;
  EXPECT_FALSE(fs::exists(out / "tables/topology-solvers-ratios.csv")) << "no row compares solvers";
  EXPECT_EQ(test::lines_of(text_of(out / "tables/silva2010-table1.csv")).size(), 33u);
  test::expect_has(text_of(out / "references.bib"), "10.1007/s00371-010-0484-4");
  test::expect_has(text_of(out / "provenance.txt"),
                   {"preset: quick", "from 2026-11-20T00:00:00Z to 2026-11-21T00:00:00Z"});
  EXPECT_EQ(report.rows.size(), rows.size());
  for (const std::string& note : report.notes) test::expect_lacks(note, "images/");
  if (report.notes.empty()) {
    EXPECT_GT(fs::file_size(out / "plots/silva2010-table1-frame-time.svg"), 5000u);
    EXPECT_EQ(text_of(out / "plots/silva2010-table1-frame-time.pdf").substr(0, 5), "%PDF-");
  }
}

/// The bibliography must contain the paper of every shipped experiment.
TEST(Report, EveryExperimentsPaperCanBeCited) {
  std::vector<FoundRow> rows;
  for (const auto& file : experiment_files()) {
    FoundRow found;
    found.row.experiment = file.stem().string();
    rows.push_back(found);
  }
  const std::string text = bibliography_of(rows);
  for (const auto& file : experiment_files()) {
    const std::string paper = read_experiment(file).paper;
    EXPECT_NE(text.find("{" + paper + ",\n"), std::string::npos) << file << ": " << paper;
  }
}

TEST(Report, CountsRowsThatWereTimedOnALoadedMachine) {
  const Folder folder;
  std::vector<FoundRow> rows = table1_rows();
  rows.resize(3);
  rows[0].row.provenance["other_cpu_share"] = 0.05;
  rows[0].row.device = "another device";
  rows[2].row.status = Status::failed_check;
  rows[2].copies = {"copy.jsonl"};
  const Report idle = write_report(rows, folder.path / "idle", note_of_hippo);
  for (const std::string& line : idle.notes) test::expect_lacks(line, "loaded machine");
  rows[1].row.provenance["other_cpu_share"] = 0.5;
  const Report loaded = write_report(rows, folder.path / "loaded", note_of_hippo);
  test::expect_has(loaded.notes.at(0), "1 of 3 rows are in several journals");
  test::expect_has(loaded.notes.at(1),
                   "1 of 2 rows were timed on a loaded machine: other processes used more than 10% of its");
  EXPECT_TRUE(fs::exists(folder.path / "loaded/tables/silva2010-table1-another_device.csv"));
}

TEST(Report, APlotThatFailsIsANote) {
  const Folder folder;
  folder.write("none.py", "raise ModuleNotFoundError(\"No module named 'matplotlib'\")\n");
  folder.write("odd.py", "raise ValueError('odd')\n");
  test::expect_has(draw_plot(folder.path / "none.py", "x", "y"), "matplotlib is not installed");
  test::expect_has(draw_plot(folder.path / "odd.py", "x", "y"), "ValueError: odd");
}

/// Returns the numbers that label the ticks of a plot of the times 48, 52 and 56 ms of three models.
std::set<std::string> tick_labels(const std::string& scale) {
  const Folder folder;
  folder.write("t.csv", "model,median_ms\na,48\nb,52\nc,56\n");
  PlotSpec plot;
  plot.x = "model";
  plot.y = "median_ms";
  plot.y_scale = scale;
  plot.x_scale = "linear";
  folder.write("t.json", json_of(plot));
  EXPECT_EQ(draw_plot(plot_program("plot"), folder.path / "t.csv", folder.path / "t"), "");
  const std::string svg = folder.read("t.svg");
  static const std::regex label(">([0-9.]+)</text>");
  const std::vector<std::string> labels = matches(svg, label);
  return {labels.begin(), labels.end()};
}

// On an axis from 48 to 56, a difference of 8% would look like the whole height of the plot.
TEST(Plot, ALinearAxisBeginsAtZero) {
  EXPECT_TRUE(tick_labels("linear").contains("0")) << testing::PrintToString(tick_labels("linear"));
}

TEST(Plot, ALogarithmicAxisHasTwoLabels) {
  EXPECT_GE(tick_labels("log").size(), 2U) << testing::PrintToString(tick_labels("log"));
}

// The length of a bar is its number only on an axis that begins at 0.
TEST(Plot, HasBarsOnALinearAxis) {
  const Folder folder;
  folder.write("t.csv",
               "model,solver,median_ms,paper_ms,paper_ms_low,paper_ms_high\na,x,48,,,\nb,x,52,50,45,55\n");
  const auto drawn = [&](bool bars, const std::string& scale) {
    PlotSpec plot;
    plot.x = "model", plot.y = "median_ms", plot.y_scale = scale, plot.x_scale = "linear";
    plot.published = "paper_ms", plot.published_label = "paper";
    plot.bars = bars;
    folder.write("t.json", json_of(plot));
    EXPECT_EQ(draw_plot(plot_program("plot"), folder.path / "t.csv", folder.path / "t"), "");
    const std::string svg = folder.read("t.svg");
    EXPECT_EQ(test::count_of(svg, ">paper</text>"), 1u);
    return test::count_of(svg, "<path") + test::count_of(svg, "fill: #0072b2");
  };
  const std::size_t points = drawn(false, "linear");
  EXPECT_NE(drawn(true, "linear"), points);
  EXPECT_EQ(drawn(true, "log"), drawn(false, "log"));
}

TEST(Report, APlaceThatCannotBeWritten) {
  const Folder folder;
  folder.write("file", "x");
  EXPECT_THROW(write_report(table1_rows(), folder.path / "file" / "r", note_of_hippo), InputError);
}

}  // namespace
}  // namespace pelage
