// Tests that the tables of a report contain every case, and that the plots name the right columns.
#include "harness/report/sections.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/table/render.hpp"
#include "tests/report/rows.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using test::sections;

Section only_section(const std::vector<FoundRow>& rows) {
  const std::vector<Section> all = sections(rows);
  EXPECT_EQ(all.size(), 1u);
  return all.at(0);
}

const Value& value(const Table& table, std::size_t line, const char* column) {
  return table.lines.at(line).at(std::size_t(column_of(table, column)));
}

double number(const Table& table, std::size_t line, const char* column) {
  return std::stod(value(table, line, column).data);
}

std::size_t line_with(const Table& table, const std::vector<std::pair<const char*, const char*>>& values) {
  for (std::size_t i = 0; i < table.lines.size(); ++i)
    if (std::all_of(values.begin(), values.end(),
                    [&](const auto& v) { return value(table, i, v.first).data == v.second; }))
      return i;
  ADD_FAILURE() << "no such line";
  return 0;
}

TEST(PaperSection, HasThePapersShape) {
  const Table t = only_section(test::table1_rows()).table;
  const Pivot pivot = pivot_of(t);
  ASSERT_EQ(pivot.groups.size(), 2u);
  EXPECT_EQ(pivot.groups[0], std::vector<std::string>{"800x600"});
  ASSERT_EQ(pivot.blocks.size(), 2u);
  EXPECT_EQ(pivot.blocks[0].label, std::vector<std::string>{"16 layers"});
  ASSERT_EQ(pivot.blocks[1].rows.size(), 8u);
  EXPECT_EQ(pivot.blocks[0].rows.front().keys[0].data, "torus");
  EXPECT_EQ(pivot.blocks[0].rows.front().keys[1].data, "9360");
  EXPECT_EQ(pivot.blocks[0].rows.back().keys[0].data, "lion");
  ASSERT_EQ(t.footnotes.size(), 1u);
  EXPECT_EQ(t.footnotes[0], std::pair(std::string("a"), std::string("hippo: stand-in: a pig & 100% so")));
  EXPECT_EQ(pivot.blocks[0].rows[2].keys[0].mark, "a");
  EXPECT_EQ(t.stem, "silva2010-table1");
}

TEST(PaperSection, AsText) {
  const std::string text = text_of(sections(test::table1_rows()).at(0).table);
  // The synthetic frame time is (triangles + pixels) * layers / 1e6 ms = (9360 + 480000) * 16 / 1e6 ms. It
  // corresponds to 127.7 fps, which is 0.478 times the paper's 267 fps.
  test::expect_has(text, {"9360    128   267  0.478", "< 1", "a hippo: stand-in",
                          "Table 1, measured on Intel Quad Core 3 GHz"});
}

TEST(PaperSection, AFailedCellShowsItsStatusAndNoTime) {
  auto rows = test::table1_rows();
  rows[0].row.status = Status::failed_check;
  rows[0].row.metrics.erase("triangles");
  rows[1].row.metrics["paper_fps"] = {0.5, "fps", "range", 0.0, 1.0};
  const Table table = sections(rows).at(0).table;
  test::expect_has(text_of(table), {"failed-check", "0..1"});
  test::expect_has(html_of(table), "class=\"bad\"");
  EXPECT_EQ(pivot_of(table).blocks[0].rows.size(), 8u) << "the failed cell stays in its model's row";
  const std::size_t line = line_with(table, {{"status", "failed-check"}});
  for (const char* column : {"fps", "fps_low", "median_ms", "median_ms_high", "ratio", "ratio_low"})
    EXPECT_EQ(value(table, line, column).data, "") << column;
  const std::size_t range = line_with(table, {{"paper_relation", "range"}});
  EXPECT_EQ(value(table, range, "paper_ms_low").data, "1000");
  for (const char* column : {"paper_ms_high", "ratio_high"}) EXPECT_EQ(value(table, range, column).data, "");
}

TEST(PaperSection, EveryTimeOfTheCsvLiesWithinItsInterval) {
  const Table table = sections(test::table1_rows()).at(0).table;
  ASSERT_EQ(table.lines.size(), 32u);
  for (std::size_t i = 0; i < table.lines.size(); ++i) {
    EXPECT_LT(number(table, i, "fps_low"), number(table, i, "fps")) << i;
    EXPECT_LT(number(table, i, "fps"), number(table, i, "fps_high")) << i;
    EXPECT_LT(number(table, i, "median_ms_low"), number(table, i, "median_ms")) << i;
    EXPECT_LT(number(table, i, "median_ms"), number(table, i, "median_ms_high")) << i;
    EXPECT_NEAR(number(table, i, "fps") * number(table, i, "median_ms"), 1000, 0.01) << i;
  }
}

TEST(PaperSection, LatexHasOneColumnPerNumber) {
  for (const std::string& line : test::lines_of(latex_of(sections(test::table1_rows()).at(0).table))) {
    if (!line.starts_with("torus")) continue;
    // Each row has 8 columns: 2 for the model, and 3 for each of 2 sizes.
    EXPECT_EQ(std::count(line.begin(), line.end(), '&'), 7) << line;
  }
}

TEST(Sections, ChangedCasesHaveASectionOfTheirOwn) {
  auto rows = test::table1_rows();
  for (FoundRow& found : rows) {
    found.row.overrides["fur.length"] = "0.1";
    found.row.metrics.erase("paper_fps");
  }
  auto both = test::table1_rows();
  both.insert(both.end(), rows.begin(), rows.end());
  const auto all = sections(both);
  ASSERT_EQ(all.size(), 2u);
  test::expect_has(all[1].table.subtitle, "changed: fur.length=0.1");
  EXPECT_EQ(all[1].table.lines.size(), 32u);
  EXPECT_EQ(all[1].table.stem, all[0].table.stem + "-length-0.1");
  EXPECT_EQ(column_of(all[1].table, "ratio"), -1) << "the paper did not time this scene";
}

/// The table of own axes must contain every case. The plot must show the numeric axis along x.
TEST(CaseSection, HasEveryCaseOfOwnAxes) {
  const auto rows = test::own_rows({{"model", {"mine.obj"}},
                                    {"curl.radius", {"0.05", "0.01", "0.1"}},
                                    {"reading", {"literal", "default"}}});
  const Section section = only_section(rows);
  const std::string text = text_of(section.table);
  test::expect_has(text, {"10.0 [", "20.0 [", "30.0 [", "40.0 [", "50.0 [", "60.0 ["});
  EXPECT_NE(text.find("0.05"), std::string::npos) << "numbers appear as they were written";
  EXPECT_EQ(value(section.table, 0, "model").shown, "mine");
  ASSERT_EQ(section.plots.size(), 1u);
  const PlotSpec& plot = section.plots[0];
  EXPECT_EQ(plot.x, "curl.radius");
  EXPECT_EQ(plot.series, std::vector<std::string>{"reading"});
  EXPECT_TRUE(plot.panels.empty());
  EXPECT_EQ(plot.y, "median_ms");
  EXPECT_EQ(plot.low, "median_ms_low");
}

TEST(CaseSection, TwoNumericAxesBecomePanels) {
  const auto all = sections(test::own_rows(
      {{"layers", {"1", "16", "20"}}, {"fur.length", {"0.05", "0.1"}}, {"model", {"a", "b"}}}));
  const PlotSpec& plot = all.at(0).plots.at(0);
  EXPECT_EQ(plot.x, "layers");
  EXPECT_EQ(plot.x_scale, "log");
  EXPECT_EQ(plot.panels, std::vector<std::string>{"fur.length"});
  EXPECT_EQ(plot.series, std::vector<std::string>{"model"});
}

TEST(CaseSection, CategoriesBecomePoints) {
  auto rows = test::own_rows({{"model", {"a", "b", "c"}}, {"variant", {"x", "y"}}});
  for (const char* x : {"", "device"}) {  // all cases have one device
    rows[0].row.provenance["view"] = {{"x", x}};
    const auto all = sections(rows);
    const PlotSpec& plot = all.at(0).plots.at(0);
    EXPECT_EQ(plot.x, "model");
    EXPECT_EQ(plot.series, std::vector<std::string>{"variant"});
  }
}

// The table has a column `drift` of the times. A metric of this name has another column, which the view
// means.
TEST(CaseSection, AMetricWithTheNameOfAColumnIsMeantByTheView) {
  auto rows = test::own_rows({{"model", {"a", "b"}}});
  for (FoundRow& found : rows) {
    found.row.metrics["drift"] = {-1.25, "of m g L0"};
    found.row.provenance["view"] = {{"values", {"drift"}}};
  }
  EXPECT_EQ(sections(rows).at(0).table.layout.values, std::vector<std::string>{"metric.drift"});
}

TEST(CaseSection, FollowsTheExperimentsView) {
  auto rows =
      test::own_rows({{"layers", {"8", "16"}}, {"fur.length", {"0.05", "0.1"}}, {"model", {"a", "b"}}});
  for (FoundRow& found : rows) {
    found.row.metrics["error_p99"] = {double(found.row.case_name.size()), "lengths", "", 1.0};
    found.row.provenance["view"] = {{"x", "fur.length"},         {"y", {"error_p99", "nothing"}},
                                    {"series", {"layers"}},      {"panels", {"model"}},
                                    {"y_scale", "log"},          {"values", {"error_p99"}},
                                    {"columns", {"fur.length"}}, {"blocks", {"model"}}};
  }
  std::vector<std::string> notes;
  const auto all = sections(rows, &notes);
  const Table& table = all.at(0).table;
  EXPECT_EQ(table.layout.blocks, std::vector<std::string>{"model"});
  EXPECT_EQ(table.layout.groups, std::vector<std::string>{"fur.length"});
  EXPECT_EQ(table.layout.rows, std::vector<std::string>{"layers"});
  EXPECT_EQ(table.layout.values, std::vector<std::string>{"error_p99"});
  ASSERT_EQ(all[0].plots.size(), 1u);
  EXPECT_EQ(all[0].plots[0].x, "fur.length");
  EXPECT_EQ(all[0].plots[0].high, "error_p99_high");
  EXPECT_EQ(all[0].plots[0].y_scale, "log");
  ASSERT_EQ(notes.size(), 1u);
  test::expect_has(notes[0], "y names \"nothing\"");
  const auto json = nlohmann::json::parse(json_of(all[0].plots[0]));
  EXPECT_EQ(json.at("x"), "fur.length");
  EXPECT_EQ(json.at("labels").at("layers"), "{} layers");
  for (const auto& [x, series] : {std::pair("model", "layers, fur.length"), {"error_p99", "layers"}}) {
    rows.back().row.provenance["view"] = {{"x", x}, {"series", {"layers"}}};
    EXPECT_EQ(joined(sections(rows).at(0).plots.at(0).series), series) << x;
  }
}

/// Returns a row for every case of rivals.toml in the paper's reading. OpenCL takes 10 ms with curls and 8 ms
/// without, OpenGL 4 times as long on the torus and else 9 times with curls and 6 times without.
std::vector<FoundRow> duel_rows() {
  std::vector<FoundRow> rows = test::bare_rows("rivals", "paper");
  std::erase_if(rows, [](const FoundRow& found) { return found.row.axes.at("reading") != "paper"; });
  for (FoundRow& found : rows) {
    Row& row = found.row;
    const bool torus = row.axes.at("model") == "torus", plain = row.axes.at("effects") == "none";
    const double ours = plain ? 8 : 10, ratio = torus ? 4 : plain ? 6 : 9;
    for (int i = 0; i < 11; ++i) {
      row.samples["frame"].wall_ms.push_back(ours);
      row.samples["opengl"].wall_ms.push_back(ours * ratio);
    }
    row.metrics["triangles"] = {torus ? 9360.0 : 20000.0, "triangles"};
    row.metrics["opengl_ratio"] = {ratio, "times", "", ratio - 1, ratio + 1};
    row.provenance["opengl_renderer"] = "softpipe, Mesa";
  }
  return rows;
}

TEST(RatioSection, HoldsEveryCellsRatioAndTheirMeans) {
  const auto rows = duel_rows();
  ASSERT_EQ(rows.size(), 64u);
  const Section section = only_section(rows);
  const Table& table = section.table;
  EXPECT_EQ(table.lines.size(), 64u);
  const Pivot pivot = pivot_of(table);
  ASSERT_EQ(pivot.groups.size(), 4u);
  EXPECT_EQ(joined(pivot.groups[1]), "16 layers, 1680x1050");
  ASSERT_EQ(pivot.blocks.size(), 2u);
  EXPECT_EQ(joined(pivot.blocks[0].label), "paper, effects all");
  EXPECT_EQ(pivot.blocks[0].rows.front().keys[0].data, "torus");
  EXPECT_EQ(pivot.blocks[0].rows.front().cells[0]->data, "4");
  EXPECT_NEAR(number(table, line_with(table, {{"model", "torus"}, {"effects", "all"}}), "opengl_ms"), 40,
              1e-9);
  // The geometric mean with curls is (4 * 9^7)^(1/8), and without (4 * 6^7)^(1/8).
  for (const std::string& text : {text_of(table), html_of(table)})
    test::expect_has(
        text,
        {"9.00 [8.00, 10.00]", "softpipe",
         fmt::format(
             "the geometric mean {:.2f} over 32 of 32 cells (no interval, because that needs three separate runs (--repeat 3)) and the minimum 4.00 (torus, all, 16 layers, 800x600)",
             std::pow(4 * std::pow(9.0, 7), 1.0 / 8)),
         fmt::format("without effects: the ratios have the geometric mean {:.2f} over 32 of 32 cells",
                     std::pow(4 * std::pow(6.0, 7), 1.0 / 8))});
  ASSERT_EQ(section.plots.size(), 1u);
  EXPECT_EQ(section.plots[0].y, "opengl_ratio");
  EXPECT_EQ(section.plots[0].guide, 1);
  EXPECT_EQ(section.plots[0].series, (std::vector<std::string>{"layers", "size"}));
  EXPECT_EQ(section.plots[0].note, "test device against softpipe, Mesa");
}

TEST(RatioSection, CountsWhatHasNoRatio) {
  std::vector<FoundRow> rows = duel_rows();
  for (FoundRow& found : rows) {
    found.row.metrics["opengl_ratio"].low.reset();  // as after a single round
    if (found.row.axes.at("model") == "torus" && found.row.axes.at("effects") == "all") {
      found.row.status = Status::failed_check;
      found.row.samples.clear();
    }
  }
  test::expect_has(html_of(sections(rows).at(0).table), {"the geometric mean 9.00 over 28 of 32 cells",
                                                         "class=\"bad\"", ">failed-check<", ">9.00<"});
}

// A variant that was not measured in turns with the baseline has a table of its times.
TEST(RatioSection, LeavesOtherVariantsToTheTableOfTimes) {
  std::vector<FoundRow> rows = duel_rows();
  for (FoundRow& found : rows)
    if (found.row.axes.at("effects") == "none") {
      found.row.variant = "alone";
      found.row.metrics.erase("opengl_ratio");
      found.row.samples.erase("opengl");
    }
  const auto all = sections(rows);
  ASSERT_EQ(all.size(), 2u);
  for (const Section& section : all) EXPECT_EQ(section.table.lines.size(), 32u);
}

/// Returns one row for every case of topology-table1.toml. A frame takes 10 ms plus its simulation, which
/// takes 0 to 4 ms depending on the topology.
std::vector<FoundRow> sweep_rows() {
  const std::map<std::string, double> cost{
      {"silva", 0}, {"sticks", 1}, {"prisms", 2}, {"separable-sticks", 3}, {"separable-prisms", 4}};
  std::vector<FoundRow> rows = test::bare_rows("topology-table1", "quick");
  for (FoundRow& found : rows) {
    Row& row = found.row;
    const double simulate = cost.at(row.axes.at("dynamics.topology"));
    for (int i = 0; i < 11; ++i) {
      row.samples["frame"].wall_ms.push_back(10 + simulate + 0.001 * (i - 5));
      row.samples["simulate"].event_ms.push_back(simulate);
      row.samples["raster"].event_ms.push_back(9);
    }
    row.metrics["triangles"] = {row.axes.at("model") == "torus" ? 9360.0 : 20000.0, "triangles"};
    row.metrics["masses"] = {12, "masses"};
  }
  return rows;
}

TEST(TopologySection, HasA160CellsAndComparesThemWithSilvasStrand) {
  const auto rows = sweep_rows();
  ASSERT_EQ(rows.size(), 160u);
  const auto all = sections(rows);
  ASSERT_EQ(all.size(), 2u);
  const Table &table = all[0].table, &shares = all[1].table;
  ASSERT_EQ(table.lines.size(), 160u);
  const Pivot pivot = pivot_of(table);
  ASSERT_EQ(pivot.groups.size(), 5u);
  EXPECT_EQ(joined(pivot.groups[0]), "silva");
  EXPECT_EQ(joined(pivot.blocks.front().label), "16 layers, 800x600");
  EXPECT_EQ(joined(pivot.blocks.back().label), "64 layers, 1680x1050");
  for (std::size_t i = 0; i < table.lines.size(); ++i) {
    const double simulate = number(table, i, "simulate_ms");
    EXPECT_NEAR(number(table, i, "ratio"), (10 + simulate) / 10, 1e-4);
    EXPECT_NEAR(number(table, i, "raster_ms"), 9, 1e-12);
  }
  const std::size_t last = line_with(shares, {{"topology", "separable-prisms"}});
  EXPECT_NEAR(number(shares, last, "by_first"), 1.4, 1e-5);
  EXPECT_NEAR(number(shares, last, "share_median"), 4.0 / 14, 1e-5);
  ASSERT_EQ(all[0].plots.size(), 2u);
  EXPECT_EQ(all[0].plots[1].y, "simulate_ms");
  EXPECT_EQ(all[0].plots[1].order.at("dynamics.topology").front(), "silva");
}

TEST(TopologySection, TellsWhatHasNoTime) {
  std::vector<FoundRow> rows = sweep_rows();
  rows[0].row.status = Status::diverged;
  rows[0].row.samples.clear();
  const Table table = sections(rows).at(0).table;
  test::expect_has(text_of(table), "diverged");
  // If the first topology has no time in a case, the other topologies have no ratio in this case.
  const Row& row = rows[0].row;
  EXPECT_EQ(row.axes.at("dynamics.topology"), "silva");
  const std::size_t beside = line_with(table, {{"model", row.axes.at("model").c_str()},
                                               {"layers", row.axes.at("layers").c_str()},
                                               {"size", row.axes.at("size").c_str()},
                                               {"dynamics.topology", "sticks"}});
  EXPECT_EQ(value(table, beside, "ratio").data, "");
}

/// A model given with --model has the same tables. All its cases have the same number of triangles, so the
/// topology is on the horizontal axis of the plot.
TEST(TopologySection, HasOwnModels) {
  std::vector<FoundRow> rows = sweep_rows();
  std::erase_if(rows, [](const FoundRow& found) { return found.row.axes.at("model") != "torus"; });
  for (FoundRow& found : rows) found.row.axes["model"] = found.row.overrides["model"] = "mine.obj";
  const auto all = sections(rows);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].table.lines.size(), 20u);
  test::expect_has(all[0].table.subtitle, "changed: model=mine.obj");
  EXPECT_EQ(all[0].plots.at(0).x, "dynamics.topology");
  EXPECT_EQ(all[0].plots.at(1).y_label, "simulate, ms");
}

/// Returns a row for every case of rival-options.toml. The variant "byte" takes 5 ms per layer, "volume"
/// fails its check, and all others take 10 ms per layer.
std::vector<FoundRow> option_rows() {
  std::vector<FoundRow> rows = test::bare_rows("rival-options", "quick");
  for (FoundRow& found : rows) {
    Row& row = found.row;
    const double ms = std::stod(row.axes.at("layers")) * (row.variant == "byte" ? 5 : 10);
    if (row.variant == "volume")
      row.status = Status::failed_check;
    else
      row.samples["frame"].wall_ms.assign(11, ms);
  }
  return rows;
}

TEST(VariantSection, HasTheFastestFirstAndNoTimeForAnotherPicture) {
  const Table table = only_section(option_rows()).table;
  const Pivot pivot = pivot_of(table);
  ASSERT_EQ(pivot.blocks[0].rows.size(), 9u);
  EXPECT_EQ(pivot.groups.size(), 2u);
  EXPECT_EQ(pivot.blocks[0].rows.front().keys[0].data, "byte");
  EXPECT_EQ(pivot.blocks[0].rows.front().keys[1].shown, "1.00");
  EXPECT_EQ(pivot.blocks[0].rows[1].keys[1].shown, "2.00");
  EXPECT_EQ(pivot.blocks[0].rows.back().keys[0].data, "volume");
  EXPECT_EQ(pivot.blocks[0].rows.back().keys[1].shown, "-");
  for (const std::string& text : {text_of(table), html_of(table)})
    test::expect_has(text, {"320 [320, 320]", "failed-check"});
  EXPECT_EQ(only_section(option_rows()).plots.at(0).x, "variant") << "layers has two values only";
  const auto four = test::own_rows({{"mood", {"a", "b", "c", "d", "e"}}, {"variant", {"a", "b", "c", "d"}}});
  EXPECT_NE(column_of(only_section(four).table, "by_fastest"), -1);
}

}  // namespace
}  // namespace pelage
