#include "harness/report/plot_spec.hpp"

#include <gtest/gtest.h>

namespace pelage {
namespace {

/// Returns a plot of two numbers in the column `name`. The view asks for logarithmic axes.
PlotSpec plot_of(const std::string& name, const std::string& heading) {
  Table table;
  table.columns = {{.name = "layers", .heading = "layers"}, {.name = name, .heading = heading}};
  table.lines = {{text_value("4"), text_value("20")}, {text_value("8"), text_value("40")}};
  std::vector<std::string> notes;
  const auto plots =
      plots_of(table, {}, {.x = "layers", .y = {name}, .x_scale = "log", .y_scale = "log"}, notes);
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

}  // namespace
}  // namespace pelage
