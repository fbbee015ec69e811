#include "harness/report/plot_spec.hpp"

#include <gtest/gtest.h>

namespace pelage {
namespace {

/// Returns the scale of y in a plot of two numbers with the given heading. The view asks for logarithmic
/// axes.
std::string scale_of_plot(const std::string& heading) {
  Table table;
  table.columns = {{.name = "layers", .heading = "layers"}, {.name = "quality", .heading = heading}};
  table.lines = {{text_value("4"), text_value("20")}, {text_value("8"), text_value("40")}};
  std::vector<std::string> notes;
  const auto plots =
      plots_of(table, {}, {.x = "layers", .y = {"quality"}, .x_scale = "log", .y_scale = "log"}, notes);
  EXPECT_EQ(plots.size(), 1u);
  return plots.empty() ? "" : plots.front().y_scale;
}

TEST(PlotSpec, DecibelsHaveALinearScale) {
  EXPECT_EQ(scale_of_plot("quality, ms"), "log");
  EXPECT_EQ(scale_of_plot("quality, dB"), "linear");
}

}  // namespace
}  // namespace pelage
