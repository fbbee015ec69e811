// Tests the remarks below the table of any experiment, the names of cases and columns in them, and plots.
#include "harness/report/case_table.hpp"
#include "harness/table/render.hpp"
#include "tests/report/rows.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

TEST(CaseSection, ANumberInANameHasTheNameOfItsAxis) {
  Cell cell;
  cell.axes = {
      {"model", "torus"}, {"curl.radius", "0.0"}, {"mood", "dry"},       {"dynamics.topology", "sticks"},
      {"layers", "16"},   {"size", "800x600"},    {"reading", "literal"}};
  EXPECT_EQ(name_of(cell), "torus, curl.radius 0.0, sticks, dry, literal, 16 layers, 800x600");
}

TEST(CaseSection, ShowsTheRatioToABaselineAndTheStepsPerFrame) {
  std::vector<FoundRow> rows =
      test::own_rows({{"dynamics.topology", {"sticks", "prisms"}}, {"variant", {"rk4", "explicit-euler"}}});
  for (FoundRow& found : rows) {
    Row& row = found.row;
    row.metrics["serial-fast_ratio"] = {2.05, "times", "", 1.9, 2.1};
    row.metrics["substeps"] = {row.variant == "rk4" ? 4.0 : 16.0, "steps"};
    row.provenance["view"] = {{"columns", {"dynamics.topology"}},
                              {"values", {"median_ms", "serial-fast_ratio"}}};
  }
  test::expect_has(text_of(test::sections(rows).at(0).table),
                   {"2.05 [1.90, 2.10]", "NAME_ratio: time of the baseline NAME divided by our time",
                    "Time steps per frame: explicit-euler 16, rk4 4."});
  for (FoundRow& found : rows) found.row.metrics["substeps"].value = 4;
  test::expect_lacks(text_of(test::sections(rows).at(0).table), "Time steps");
}

TEST(CaseSection, SaysWhichCaseARatioAboveOneMakesSlower) {
  std::vector<FoundRow> rows = test::own_rows({{"mood", {"dry", "wet"}}});
  const auto text_with = [&](const std::string& ratio) {
    for (FoundRow& found : rows) {
      found.row.metrics = {{ratio, {1.25, "times", "", 1.2, 1.3}}};
      found.row.provenance["view"] = {{"values", {ratio}}};
    }
    return text_of(test::sections(rows).at(0).table);
  };
  test::expect_has(text_with("frame_over_baseline"), "Above 1, the case is slower.");
  test::expect_lacks(text_with("frame_over_baseline"), "ours is faster");
  test::expect_has(text_with("frame_over_half"), "divided by the time of a frame with half");
  test::expect_lacks(text_with("frame_over_half"), "ours is faster");
}

// The titles of these experiments promise frames per second. Their preset smoke has no published numbers.
TEST(CaseSection, CasesWithoutPublishedNumbersOfTable1ShowFramesPerSecond) {
  std::vector<FoundRow> rows = test::bare_rows("silva2010-table1", "smoke");
  ASSERT_FALSE(rows.empty());
  for (FoundRow& found : rows) found.row.samples["frame"].wall_ms.assign(5, 20.0);  // too few to converge
  const Table table = test::sections(rows).at(0).table;
  EXPECT_EQ(table.layout.values, std::vector<std::string>{"fps"});
  test::expect_has(text_of(table), {"Frames per second: 1000 divided by", "50.0*"});
  test::expect_lacks(text_of(table), "[");  // five samples give no interval
}

// Figures 9 to 11 of Banisch and Wuethrich 2006: the variants (solvers) are bars of one plot per reading,
// beside the numbers that the text prints.
TEST(PaperSection, ShowsVariantsSideBySideIfTheViewNamesThem) {
  std::vector<FoundRow> rows = test::bare_rows("banisch2006-update-time", "quick");
  for (FoundRow& found : rows) {
    Row& row = found.row;
    row.samples["frame"].wall_ms.assign(11, 10.0);
    if (row.axes.at("model") == "banisch-elephant" && row.variant != "drawing")
      row.metrics["paper_fps"] = {24.5, "fps", "range", 22.0, 27.0};
  }
  const std::vector<Section> all = test::sections(rows);
  ASSERT_EQ(all.size(), 2u);
  for (const Section& section : all) {
    EXPECT_EQ(section.table.lines.size(), 60u);
    EXPECT_EQ(pivot_of(section.table).groups.size(), 5u);
    ASSERT_FALSE(section.plots.empty());
    const PlotSpec& plot = section.plots.front();
    EXPECT_TRUE(plot.bars);
    EXPECT_EQ(plot.x, "dynamics.topology");
    EXPECT_EQ(plot.series, std::vector<std::string>{"variant"});
    EXPECT_EQ(plot.panels, std::vector<std::string>{"model"});
    EXPECT_EQ(plot.published, "paper_ms");
  }
  EXPECT_EQ(all[0].table.stem, "banisch2006-update-time");
  EXPECT_EQ(all[1].table.stem, "banisch2006-update-time-pelage");
}

TEST(CaseSection, NamesCasesWhoseTimesDrift) {
  auto rows = test::table1_rows();
  rows.resize(1);
  rows[0].row.metrics.erase("paper_fps");
  test::expect_lacks(text_of(test::sections(rows).at(0).table), "drift");
  EXPECT_TRUE(test::sections(rows).at(0).plots.empty()) << "a plot of one number";
  auto& times = rows[0].row.samples["frame"].wall_ms;
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = 10 + 0.1 * double(i);
  test::expect_has(text_of(test::sections(rows).at(0).table),
                   "Times drift during the run: torus, 16 layers, 800x600 (+18.2%).");
}

TEST(CaseSection, NamesCasesWithEqualPictures) {
  std::vector<FoundRow> rows = test::own_rows({{"mood", {"dry", "soaked", "windy"}}});
  rows[0].row.image_hash = rows[1].row.image_hash = "0000000000000001";
  rows[2].row.image_hash = "0000000000000002";
  const auto text = [&] { return text_of(test::sections(rows).at(0).table); };
  const std::string remark =
      "\nEqual pictures: (dry) and (soaked). The settings in which these cases differ change no pixel.\n";
  EXPECT_EQ(test::count_of(text(), remark), 1u) << text();
  rows[1].row.image_hash = "0000000000000003";
  test::expect_lacks(text(), "Equal pictures");
  // Variants are different ways to compute the same picture.
  rows = test::own_rows({{"variant", {"a", "b"}}});
  rows[0].row.image_hash = rows[1].row.image_hash = "0000000000000001";
  test::expect_lacks(text(), "Equal pictures");
  std::vector<CasePicture> pictures;
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g"}) pictures.push_back({name, "", "1"});
  test::expect_has(equal_pictures(pictures), ": (a), (b), (c), (d), (e) and 2 others. ");
  pictures.resize(6);
  test::expect_has(equal_pictures(pictures), ": (a), (b), (c), (d), (e) and (f). ");
}

/// Returns a plot of two numbers in the column `name`. The view asks for logarithmic axes, or those of
/// `scale`.
PlotSpec plot_of(const std::string& name, const std::string& heading, const std::string& low = "20",
                 const std::string& high = "40", const std::string& scale = "log") {
  Table table;
  table.columns = {{.name = "layers", .heading = "layers"}, {.name = name, .heading = heading}};
  table.lines = {{text_value("4"), text_value(low)}, {text_value("8"), text_value(high)}};
  std::vector<std::string> notes;
  const auto plots =
      plots_of(table, {}, {.x = "layers", .y = {name}, .x_scale = scale, .y_scale = scale}, notes);
  EXPECT_EQ(plots.size(), 1u);
  return plots.empty() ? PlotSpec{} : plots.front();
}

TEST(PlotSpec, DecibelsHaveALinearScale) {
  EXPECT_EQ(plot_of("quality", "quality, ms").y_scale, "log");
  EXPECT_EQ(plot_of("quality", "quality, dB").y_scale, "linear");
}

TEST(PlotSpec, RatiosToABaselineHaveALineAtOne) {
  EXPECT_EQ(plot_of("frame_over_baseline", "frame_over_baseline, times").guide, 1);
  EXPECT_EQ(plot_of("quality", "quality, times").guide, std::nullopt);
}

TEST(PlotSpec, ALogarithmicScaleNeedsPositiveNumbersThatDifferByAFactorOfTwenty) {
  for (const auto& [low, high] : {std::pair("1", "20"), {"0.01", "0.3"}})
    EXPECT_EQ(plot_of("n", "n", low, high, "").y_scale, "log");
  for (const auto& [low, high] : {std::pair("1", "19"), {"2", "39"}, {"0", "20"}, {"-1", "20"}})
    EXPECT_EQ(plot_of("n", "n", low, high, "").y_scale, "linear") << low;
}

TEST(PlotSpec, MoreThanSevenSeriesBecomeAtMostTwelvePanels) {
  const auto plot = [](int models, int layers) {
    std::vector<FoundRow> rows;
    for (int i = 0; i < models; ++i) {
      const std::string name = fmt::format("m{}", i), n = std::to_string(i % layers);
      rows.push_back(test::own_rows({{"model", {name}}, {"mood", {name}}, {"layers", {n}}}).front());
    }
    return test::sections(rows).at(0).plots.at(0);
  };
  EXPECT_EQ(plot(7, 2).x, "layers");
  EXPECT_EQ(plot(8, 2).x, "model") << "lines of two points";
  EXPECT_TRUE(plot(7, 3).panels.empty());
  for (const int models : {8, 12}) EXPECT_EQ(plot(models, 3).panels, std::vector<std::string>{"model"});
  EXPECT_TRUE(plot(13, 3).panels.empty());
}

using Warnings = std::vector<std::string>;

TEST(ViewCheck, NamesAMisspeltAxisOrTime) {
  const std::map<std::string, std::string> axes{{"layers", "4"}, {"mood", "calm"}};
  EXPECT_EQ(
      view_warnings({.y = {"medan_ms"}, .series = {"mood"}, .panels = {"mediam_mz"}}, axes),
      (Warnings{
          "report.y names the column medan_ms, which is neither an axis nor a time of the table; did you mean median_ms?",
          "report.panels names the column mediam_mz, which is neither an axis nor a time of the table; did you mean median_ms?"}));
  // The names of phases and metrics are not known before the run.
  EXPECT_EQ(view_warnings({.x = "triangles", .y = {"mexiam_mz", "median_gap_ms"}, .panels = {"mood"}}, axes),
            Warnings{});
}

TEST(ViewCheck, RefusesWhatNoReportCanDraw) {
  const std::map<std::string, std::string> axes{{"layers", "4"}, {"mood", "calm"}};
  const auto refused = [&](const View& view) {
    return test::refusal([&] { view_warnings(view, axes); }, "");
  };
  EXPECT_EQ(
      refused({.x = "moon"}),
      "report.x names the column moon, which is neither an axis nor a time of the table; did you mean mood?");
  EXPECT_EQ(refused({.x = "fur.layers"}),
            "report.x names fur.layers, which is no axis of the experiment (its axes: layers, mood)");
  test::expect_has(refused({.series = {"camera.eye"}}), "report.series names camera.eye, which is no axis");
  EXPECT_EQ(view_warnings({.x = "camera.eye"}, {{"camera.eye", "[0, 0, 1]"}}), Warnings{});
}

// The time of a simulated second is no frame, and has no frame rate.
TEST(CaseSection, NamesWhatASampleIs) {
  std::vector<FoundRow> rows = test::own_rows({{"dynamics.step", {"0.001", "0.002"}}});
  test::expect_has(text_of(test::sections(rows).at(0).table), "frame, ms");
  for (FoundRow& found : rows) found.row.provenance["pipeline"] = "springs-error";
  const Section section = test::sections(rows).at(0);
  test::expect_has(text_of(section.table),
                   {"one simulated second, ms", "median of the wall times of warm samples"});
  EXPECT_FALSE(has_column(section.table, "fps"));
  EXPECT_EQ(section.plots.at(0).y_label, "one simulated second, ms");
  // Rows of earlier versions do not name the pipeline; the shipped experiment does.
  rows = test::bare_rows("topology-drift", "quick");
  for (FoundRow& found : rows) found.row.samples["frame"].wall_ms.assign(11, 10.0);
  test::expect_has(text_of(test::sections(rows).at(0).table), "Four simulated seconds: 10.0 to 10.0 ms.");
}

TEST(CaseSection, APictureComparedWithItselfHasNoNumberOfDecibels) {
  std::vector<FoundRow> rows = test::own_rows({{"layers", {"16", "64"}}});
  rows[0].row.metrics["baseline_psnr"] = {31.5, "dB"};
  rows[1].row.metrics["baseline_psnr"] = {200, "dB"};
  for (FoundRow& found : rows)
    found.row.provenance["view"] = {{"values", {"baseline_psnr"}}, {"y", {"baseline_psnr"}}};
  const Section section = test::sections(rows).back();  // after the table of the cheapest cases
  test::expect_has(text_of(section.table), {"31.5", "equal"});
  test::expect_has(csv_of(section.table), ",inf");
  EXPECT_TRUE(section.plots.empty()) << "a plot of one number";
}

TEST(CaseSection, FiguresHaveNoPlots) {
  EXPECT_TRUE(test::sections(test::own_rows({{"figure", {"a", "b", "c"}}})).at(0).plots.empty());
  EXPECT_FALSE(test::sections(test::own_rows({{"mood", {"a", "b", "c"}}})).at(0).plots.empty());
}

TEST(ViewCheck, AcceptsTheShippedExperiments) {
  for (const auto& file : experiment_files()) {
    const Experiment experiment = read_experiment(file);
    std::map<std::string, std::string> axes;
    for (const Axis& axis : experiment.axes) axes[axis.key] = axis.values.front();
    EXPECT_EQ(view_warnings(experiment.view, axes), Warnings{}) << file;
  }
}

}  // namespace
}  // namespace pelage
