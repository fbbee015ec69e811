// Tests the text on the cost of layers, and that plots/scaling.py finds the coefficients of a synthetic
// table.
#include <cmath>
#include <cstdlib>

#include "harness/report/plot_spec.hpp"
#include "harness/report/report.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

/// Returns cells with synthetic frame times. The frame time is 1 ms + 40 ns * triangles + 2 ns * triangles *
/// layers + 10 ns * pixels * layers, multiplied by a factor between 0.99 and 1.01.
std::vector<Cell> cells() {
  std::vector<Cell> result;
  int i = 0;
  for (const int triangles : {9360, 37440, 149760, 2000000})
    for (const int layers : {16, 32, 64, 128})
      for (const auto& [size, pixels] :
           {std::pair("400x300", 120000), {"800x600", 480000}, {"1680x1050", 1764000}}) {
        Cell c;
        c.experiment = "scaling";
        c.device = "device";
        c.axes = {{"model", std::to_string(triangles)}, {"layers", std::to_string(layers)}, {"size", size}};
        c.case_name = std::to_string(triangles) + "-" + std::to_string(layers) + "-" + size;
        c.metrics["triangles"] = {double(triangles), "triangles"};
        c.metrics["peak_memory"] = {double(1 << 20) * (100 + ++i), "bytes"};
        c.median_ms = (1 + 4e-5 * triangles + 2e-6 * triangles * layers + 1e-5 * pixels * layers) *
                      (1 + 0.01 * std::sin(7.0 * i));
        c.interval_ms = {0.99 * c.median_ms, 1.01 * c.median_ms};
        result.push_back(c);
      }
  return result;
}

TEST(Scaling, OnlyItsOwnCellsWithATimeCount) {
  std::vector<Cell> all = cells();
  all[0].overrides = {{"fur.length", "0.1"}};
  all[1].median_ms = 0;
  all[2].experiment = "silva2010-table1";
  all[3].axes["layers"] = "1";
  all[3].median_ms = all[3].metrics["triangles"].value = 0.5;
  all[4].axes.erase("size");
  all[5].axes.erase("layers");
  all[6].metrics.erase("triangles");
  EXPECT_EQ(scaling_cells(all).size(), all.size() - 6);
}

TEST(Scaling, LayersDrawnInTurnsAreTheirOwnTable) {
  Cell c;
  c.experiment = "layers";
  c.device = "device";
  c.axes = {{"model", "bunny"}, {"layers", "64"}, {"size", "800x600"}};
  c.status = Status::ok;
  c.median_ms = 200;
  c.metrics["frame_over_half"] = {1.8, "times", "", 1.7, 1.9};
  std::vector<Cell> all{c};
  EXPECT_TRUE(in_turns_cells(all).empty());  // no quarter
  all[0].metrics["frame_over_quarter"] = {3.2, "times", "", 3.1, 3.4};
  all.push_back(all[0]);
  all[1].status = Status::failed_check;
  all[1].metrics["frame_over_half"].value = 9;
  const std::vector<Cell> shown = in_turns_cells(all);
  ASSERT_EQ(shown.size(), 1u);
  test::expect_has(in_turns_csv(shown), "device,bunny,0,64,800x600,200,1.8,1.7,1.9,3.2,3.1,3.4");
  test::expect_has(
      in_turns_text(shown),
      "A frame with twice the layers takes at most 1.80 times as long (limit: 2.05); a frame with four times the layers takes at most 3.20");
  EXPECT_TRUE(in_turns_text({}).empty());
}

TEST(Scaling, SaysWhatMoreLayersCost) {
  std::vector<Cell> two;
  for (const Cell& c : cells())
    if (c.axis("model") == "9360" && c.axis("size") == "800x600") two.push_back(c);
  two[0].median_ms = 10;
  two[1].median_ms = 19;
  two[2].median_ms = 40;
  two[3].median_ms = 70;
  EXPECT_EQ(scaling_text({}), "");
  const std::string text = scaling_text(two);
  test::expect_has(
      text, {"1.90 times", "A frame with twice the layers takes at most 2.11 times as long (limit: 2.05)",
             "64 layers take at most 4.00 times the time of 16 layers (limit: 3.3)",
             "Most memory: 111 MiB, 9360-128-800x600"});
}

/// Returns a cell (the result of one case) with the median frame time `ms`. The case has a model of 9360
/// triangles and a picture of 800x600 pixels.
Cell timed(const std::string& host, int layers, double ms) {
  Cell c = cells().at(1);
  c.host = host;
  c.axes["layers"] = std::to_string(layers);
  c.median_ms = ms;
  return c;
}

TEST(Scaling, ComparesSixtyFourLayersWithSixteenOnly) {
  const std::string text = scaling_text({timed("h", 8, 6), timed("h", 16, 10), timed("h", 64, 30)});
  test::expect_has(text, "64 layers take at most 3.00 times the time of 16 layers");
}

TEST(Scaling, ComparesCellsOfOneHostOnly) {
  test::expect_has(scaling_text({timed("slow", 16, 20), timed("fast", 16, 10), timed("fast", 32, 18),
                                 timed("slow", 32, 38)}),
                   {"10.00 ->     18.00 ms, 1.80 times", "20.00 ->     38.00 ms, 1.90 times",
                    "A frame with twice the layers takes at most 1.90 times as long"});
}

TEST(Scaling, TheFitFindsTheCostsAndForetellsWhatItHasNotSeen) {
  const test::Folder place;
  const fs::path& folder = place.path;
  test::write_text(folder / "t.csv", scaling_csv(cells()));
  ASSERT_EQ(draw_plot(plot_program("scaling"), folder / "t.csv", folder / "t"), "");
  const std::string fit = test::text_of(folder / "t.txt");
  const auto cost = [&](const std::string& term) {
    const auto at = fit.find("per " + term + " ");
    return at == std::string::npos ? -1 : std::strtod(fit.c_str() + at + 25, nullptr);
  };
  EXPECT_NEAR(cost("pixel and layer"), 10, 0.5) << fit;
  EXPECT_NEAR(cost("triangle and layer"), 2, 0.5) << fit;
  test::expect_has(fit, {"fitted to 18 cases", "9 cases held out", "21 cases beyond the fit"});
  // The fit must hold out a third of the cases of every picture size, and a third of the cases of every
  // number of layers.
  for (const char* axis : {"-400x300 ", "-800x600 ", "-1680x1050 ", "9360-16-", "9360-32-", "9360-64-"}) {
    int left_out = 0;
    for (std::size_t at = fit.find(axis); at != std::string::npos; at = fit.find(axis, at + 1)) {
      const std::string line = fit.substr(at, fit.find('\n', at) - at);
      left_out += line.ends_with("held out");
    }
    EXPECT_EQ(left_out, std::string(axis).ends_with(' ') ? 3 : 1) << axis << fit;
  }
  test::expect_has(test::text_of(folder / "t.svg"), "128");
  // With too few cases the plot program must report an error and must not compute a fit.
  std::vector<Cell> few = cells();
  few.resize(6);
  test::write_text(folder / "few.csv", scaling_csv(few));
  test::expect_has(draw_plot(plot_program("scaling"), folder / "few.csv", folder / "few"), "too few");
}

}  // namespace
}  // namespace pelage
