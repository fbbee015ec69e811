#include "harness/report/view_check.hpp"

#include <gtest/gtest.h>

#include "harness/experiment/experiment.hpp"

namespace pelage {
namespace {

using Warnings = std::vector<std::string>;

TEST(ViewCheck, NamesAMisspeltAxisOrTime) {
  const std::map<std::string, std::string> axes{{"layers", "4"}, {"mood", "calm"}};
  EXPECT_EQ(
      view_warnings({.x = "layer", .y = {"medan_ms"}, .series = {"mood"}}, axes),
      (Warnings{
          "report.x names the column layer, which is neither an axis nor a time of the table; did you "
          "mean layers?",
          "report.y names the column medan_ms, which is neither an axis nor a time of the table; did you "
          "mean median_ms?"}));
  // The names of phases and metrics are not known before the run.
  EXPECT_EQ(view_warnings({.x = "triangles", .y = {"simulate_ms", "error_rms"}, .panels = {"mood"}}, axes),
            Warnings{});
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
