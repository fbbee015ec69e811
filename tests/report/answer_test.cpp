// Tests the sentence above a table, and the table of the cheapest cases.
#include "harness/report/answer.hpp"

#include "harness/report/comparison.hpp"
#include "harness/table/render.hpp"
#include "tests/report/rows.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using test::own_rows;

std::vector<FoundRow> with_metric(std::vector<FoundRow> rows, const std::string& name,
                                  const std::string& unit, const std::vector<double>& values) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].row.metrics[name] = {values.at(i % values.size()), unit};
  return rows;
}

TEST(Answer, NamesTheTwoStrongestEffects) {
  // 10 ms for a, 8; 20 for a, 16; 30 for b, 8; 40 for b, 16
  const std::string text = answer_of(cells_of(own_rows({{"mood", {"a", "b"}}, {"layers", {"8", "16"}}})));
  EXPECT_EQ(
      text,
      "Frame: 10.0 to 40.0 ms; mood b takes 2.45 (geometric mean of 2 cases, 2.00 to 3.00) times as long as a; "
      "layers 16 takes 1.63 (geometric mean of 2 cases, 1.33 to 2.00) times as long as 8.");
  EXPECT_EQ(answer_of(cells_of(own_rows({{"layers", {"8"}}}))), "Frame: 10.0 ms.");
  EXPECT_EQ(answer_of({}), "");
}

TEST(Answer, GivesTheMeanOfRatios) {
  const std::vector<FoundRow> rows =
      with_metric(own_rows({{"layers", {"8", "16"}}}), "opengl_ratio", "times", {4, 9});
  EXPECT_EQ(
      answer_of(cells_of(rows)),
      "OpenGL's frame time / our frame time: 6.00 (geometric mean of 2 cases; 4.00 for layers 8 to 9.00 for "
      "layers 16).");
  test::expect_has(answer_of(cells_of(test::table1_rows())), "Our frame rate / the paper's: ");
}

// Cases a to d take 10 to 40 ms for the first model and 50 to 80 ms for the second.
TEST(Answer, NamesTheCheapestCaseForALimit) {
  std::vector<FoundRow> rows =
      with_metric(own_rows({{"model", {"m", "n"}}, {"solver", {"a", "b", "c", "d"}}}), "error_rms",
                  "of the length", {0.2, 0.03, 0.005, 0.0005});
  rows[6].row.status = Status::diverged;
  const std::vector<Cell> cells = cells_of(rows);
  EXPECT_EQ(
      answer_of(cells),
      "With error_rms at most 5% of the fur's length, the cheapest is for m b (20.0 ms), for n b (60.0 ms); with error_rms at "
      "most 1% of the fur's length, the cheapest is for m c (30.0 ms), for n d (80.0 ms).");
  const Table table = choices_of(cells).value();
  EXPECT_EQ(table.lines.size(), 8u);
  const std::string csv = csv_of(table);
  test::expect_has(csv, {"model,limit,choice,median_ms,value,close\n",
                         "m,error_rms at most 0.1% of the fur's length,d,40,0.0005,\n",
                         "n,error_rms at most 1% of the fur's length,d,80,0.0005,\n",
                         "n,error_rms at most 0.01% of the fur's length,none,,,\n"});
  rows[3].row.metrics["error_rms"].value = 0.000113506;  // is above the limit 0.0001
  test::expect_has(csv_of(choices_of(cells_of(rows)).value()),
                   "m,error_rms at most 0.01% of the fur's length,none,,,\n");
}

// Cases whose intervals overlap are named. The errors of topologies are those of different motions.
TEST(Answer, NamesCasesThatAreAsFast) {
  std::vector<FoundRow> rows =
      with_metric(own_rows({{"dynamics.topology", {"sticks"}}, {"solver", {"a", "b", "c"}}}), "error_rms",
                  "of the length", {0.02});
  for (FoundRow& found : rows)
    found.row.samples["frame"].wall_ms = {9, 9.5, 10, 10, 10, 10, 10, 10, 10, 10.5, 11};
  EXPECT_EQ(
      answer_of(cells_of(rows)),
      "With error_rms at most 5% of the fur's length, the cheapest is a (10.0 ms; within its interval: b; 1 more); with "
      "error_rms at most 1% of the fur's length, the cheapest is none.");
  test::expect_has(csv_of(choices_of(cells_of(rows)).value()),
                   "error_rms at most 5% of the fur's length,a,10,0.02,b; 1 more\n");
}

// Without a view, the error stands beside the time and is drawn against it.
TEST(Answer, ShowsTheErrorWithoutAView) {
  const std::vector<FoundRow> rows =
      with_metric(own_rows({{"dynamics.topology", {"sticks", "prisms"}}, {"step", {"0.001", "0.002"}}}),
                  "error_rms", "of the length", {0.003, 0.03});
  const std::vector<Section> all = test::sections(rows);
  EXPECT_EQ(all.back().table.layout.values, (std::vector<std::string>{"median_ms", "error_rms"}));
  ASSERT_EQ(all.back().plots.size(), 1u);
  EXPECT_EQ(all.back().plots[0].x, "median_ms");
  EXPECT_EQ(all.back().plots[0].y, "error_rms");
}

// The likeness to a control scene is a quality only if the cases approximate that scene by fewer layers, not
// if they are other scenes, such as wet fur beside dry fur.
TEST(Answer, ComparesWithTheControlSceneOnlyWhatApproximatesIt) {
  const auto rows = [](const std::string& key, const std::vector<std::string>& values) {
    return with_metric(with_metric(own_rows({{key, values}}), "baseline_psnr", "dB", {28, 36, 200}),
                       "baseline_ssim", "", {0.8, 0.97, 1});
  };
  const std::string text = answer_of(cells_of(rows("layers", {"16", "64", "256"})));
  EXPECT_EQ(
      text,
      "With baseline_ssim against layers 256 at least 0.95, the cheapest is layers 64 (20.0 ms); with baseline_ssim against layers 256 at least 0.99, "
      "the cheapest is none.");
  test::expect_has(answer_of(cells_of(rows("water", {"wet", "damp", "dry"}))), "Frame: ");
  EXPECT_FALSE(choices_of(cells_of(rows("water", {"wet", "damp", "dry"}))));
}

// The view names what an experiment is about.
TEST(Answer, LeavesOutWhatTheViewDoesNotDraw) {
  std::vector<FoundRow> rows =
      with_metric(own_rows({{"solver", {"a", "b"}}}), "error_rms", "of the length", {0.03, 0.003});
  for (FoundRow& found : rows) found.row.provenance["view"] = {{"y", {"median_ms"}}};
  EXPECT_FALSE(choices_of(cells_of(rows)));
  for (FoundRow& found : rows) found.row.provenance["view"] = {{"x", "median_ms"}, {"y", {"error_rms"}}};
  EXPECT_TRUE(choices_of(cells_of(rows)));
}

TEST(ComparisonTable, NamesWhatTheTwoSidesAre) {
  const std::vector<Cell> cells = cells_of(own_rows({{"layers", {"8", "16"}}, {"threads", {"1", "2"}}}));
  const CompareBy by("axes.threads");
  const Table table = comparison_table(compare_cells(cells, {}, true, by, {}), by);
  EXPECT_EQ(table.subtitle, "own shells/tile test device@h");
  const std::string text = text_of(table);
  test::expect_has(text, {"Frame times by threads", "threads=1, ms", "threads=2, ms", "+100.0%"});
  EXPECT_LT(text.find("layers=8"), text.find("layers=16"));
  const PlotSpec plot = comparison_plot(table);
  EXPECT_EQ(plot.x, "case");
  EXPECT_EQ(plot.y, "change");
  EXPECT_TRUE(plot.series.empty());
  // With three values, each pair is a line that names its two values.
  const std::vector<Cell> three = cells_of(own_rows({{"threads", {"1", "2", "4"}}}));
  const Table pairs = comparison_table(compare_cells(three, {}, true, by, {}), by);
  test::expect_has(text_of(pairs), {"threads A", "threads B", "A, ms"});
  EXPECT_EQ(pairs.lines.size(), 3u);
  EXPECT_EQ(comparison_plot(pairs).series, (std::vector<std::string>{"a", "b"}));
}

}  // namespace
}  // namespace pelage
