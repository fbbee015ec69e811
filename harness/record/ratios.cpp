#include "harness/record/ratios.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "harness/record/row.hpp"

namespace pelage {
namespace {

/// The phases whose metric PHASE_ratio was the time of the frame divided by the time of the phase. The list
/// is complete, because only rows of schemas 1 and 2 have such metrics.
constexpr std::array<std::string_view, 3> inverted{"half", "quarter", "baseline"};

/// Replaces old names of metrics in a view: its members are texts or lists of texts.
void rename_columns(nlohmann::ordered_json& view) {
  if (view.is_string()) view = present_metric(view.get<std::string>());
  if (view.is_structured())
    for (auto& member : view) rename_columns(member);
}

}  // namespace

std::string ratio_metric(const std::string& phase) {
  return phase + "_ratio";
}

std::string frame_over_metric(const std::string& phase) {
  return "frame_over_" + phase;
}

std::vector<double> ratios_by_round(std::span<const double> a, std::span<const double> b) {
  std::vector<double> ratios(a.size());
  std::transform(a.begin(), a.end(), b.begin(), ratios.begin(), [](double x, double y) { return x / y; });
  return ratios;
}

std::string present_metric(const std::string& name) {
  for (const std::string_view phase : inverted)
    if (name == ratio_metric(std::string(phase))) return frame_over_metric(std::string(phase));
  return name;
}

std::string present_metric(const std::string& name, const std::string& place) {
  std::string present = present_metric(name);
  if (present != name)
    fmt::print(stderr, "pelage: {}: the metric {} is now called {}\n", place, name, present);
  return present;
}

void convert_to_present(Row& row) {
  std::map<std::string, Metric> metrics;
  for (auto& [name, metric] : row.metrics) metrics[present_metric(name)] = std::move(metric);
  row.metrics = std::move(metrics);
  if (const auto view = row.provenance.find("view"); view != row.provenance.end()) rename_columns(*view);
  if (row.schema > 1) row.schema = kRowSchema;
}

}  // namespace pelage
