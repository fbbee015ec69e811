// Makes the report section of any experiment that has no special section (sections.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "harness/report/answer.hpp"
#include "harness/report/case_table.hpp"
#include "harness/report/sections.hpp"

namespace pelage {
namespace {

/// A key column (axis or variant) gives groups of columns, one per value, only if it has at most this number
/// of values.
constexpr std::size_t most_groups = 5;

/// Least number of variants for of_variants(), which also needs an experiment without a table [report] and
/// with at most `most_groups` cases per variant.
constexpr std::size_t fewest_variants = 4;

/// Returns the columns of the metrics `names`: "metric.NAME" where a column of the table has the name of a
/// metric.
std::vector<std::string> metric_columns(const Table& table, std::vector<std::string> names) {
  for (std::string& name : names) {
    std::string own = fmt::format("metric.{}", name);
    if (has_column(table, own)) name = std::move(own);
  }
  return names;
}

/// Returns for each variant the geometric mean over the cases of its frame time divided by that of the
/// fastest variant.
std::map<std::string, double> by_fastest(const std::vector<Cell>& cells) {
  std::map<std::string, double> fastest;  // name_of() of a case -> least frame time in ms
  for (const Cell& c : cells)
    if (timed(c)) {
      double& least = fastest.emplace(name_of(c), c.median_ms).first->second;
      least = std::min(least, c.median_ms);
    }
  std::map<std::string, std::vector<double>> ratios;
  for (const Cell& c : cells)
    if (timed(c)) ratios[c.variant].push_back(c.median_ms / fastest.at(name_of(c)));
  std::map<std::string, double> means;
  for (const auto& [variant, list] : ratios) means[variant] = geometric_mean(list);
  return means;
}

/// Makes the section of an experiment that compares variants: one row per variant, the fastest first, and
/// groups of columns for the values of all axes that vary.
Section of_variants(std::vector<Cell> cells, const std::string& stem, const Sources& sources) {
  const auto means = by_fastest(cells);
  const auto mean = [&](const Cell& c) { return found_in(means, c.variant); };
  constexpr double last = std::numeric_limits<double>::infinity();  // for variants without a time
  std::ranges::stable_sort(cells, {},
                           [&](const Cell& c) { return std::pair(mean(c).value_or(last), c.variant); });
  auto columns = case_columns(cells);
  columns.push_back({{"by_fastest", "times"}, [&](const Cell& c) {
                       Value value = number_value(mean(c));
                       if (mean(c)) value.shown = fmt::format("{:.2f}", *mean(c));
                       return value;
                     }});
  Layout layout{{}, {"variant", "by_fastest"}, {}, {"median_ms"}};
  for (const std::string& key : varying_keys(table_of(cells, columns), cells))
    if (key != "variant") layout.groups.push_back(key);
  return section_of(
      cells, columns, stem, sources, layout,
      {"times: frame time of the variant divided by the frame time of the fastest variant with a correct picture (geometric mean over the cases)."});
}

/// Makes a section that normally has one row per case. But if the last key column that varies has no more
/// than `most_groups` values, each of these values becomes a group of columns.
Section of_cases(std::vector<Cell> cells, const View& view, const std::string& stem, const Sources& sources) {
  sort_cells(cells);
  const auto columns = case_columns(cells);
  const Table table = table_of(cells, columns);
  Layout layout{present(table, view.blocks),
                {},
                present(table, view.columns),
                present(table, metric_columns(table, view.values))};
  const std::vector<std::string> keys = varying_keys(table, cells);
  if (layout.groups.empty() && keys.size() >= 2 && values_of(table, keys.back()).size() <= most_groups &&
      std::find(layout.blocks.begin(), layout.blocks.end(), keys.back()) == layout.blocks.end())
    layout.groups = {keys.back()};
  if (layout.values.empty()) layout.values = {"median_ms"};
  return section_of(cells, columns, stem, sources, layout, {});
}

/// Returns a remark with the number of time steps per frame (metric substeps) of each variant: "Time steps
/// per frame: rk4 4, explicit-euler 16." Returns "" if all are equal, or if they also depend on other axes.
std::string steps_remark(const std::vector<Cell>& cells) {
  std::map<std::string, std::set<double>> steps;  // variant -> numbers
  std::set<double> all;
  for (const Cell& c : cells)
    if (const Metric* metric = c.metric("substeps")) {
      steps[c.variant].insert(metric->value);
      all.insert(metric->value);
    }
  if (all.size() < 2) return {};
  std::string text;
  for (const auto& [variant, numbers] : steps) {
    if (numbers.size() > 1) return {};
    text += fmt::format("{}{} {:g}", text.empty() ? "" : ", ", variant, *numbers.begin());
  }
  return fmt::format("Time steps per frame: {}.", text);
}

std::vector<std::string> value_remarks(const std::vector<std::string>& values,
                                       const std::vector<Cell>& cells) {
  const std::string sample = sample_of(cells), control = control_of(cells);
  const auto shows = [&](const char* name) { return std::ranges::find(values, name) != values.end(); };
  std::vector<std::string> remarks;
  if (shows("median_ms"))
    remarks.push_back(
        sample == "frame"
            ? "Frame time: median of the wall times of warm frames, in ms, and its 95% interval."
            : fmt::format("{}, ms: median of the wall times of warm samples, and its 95% interval.", sample));
  if (shows("fps"))
    remarks.emplace_back(
        "Frames per second: 1000 divided by the median wall time of a warm frame in ms, and its 95% interval.");
  if (shows("frame_over_baseline"))
    remarks.emplace_back(
        "frame_over_baseline: time of the case divided by the time of the control scene in the same rounds, and its 95% interval. Above 1, the case is slower.");
  if (shows("baseline_psnr") || shows("baseline_ssim"))
    remarks.push_back(fmt::format(
        "baseline_psnr, baseline_ssim: likeness of the case's picture to that of its control scene{}.",
        control.empty() ? "" : " (" + control + ")"));
  if (shows("frame_over_half") || shows("frame_over_quarter"))
    remarks.emplace_back(
        "frame_over_half, frame_over_quarter: time of the frame divided by the time of a frame with half or a quarter of the layers in the same rounds, and its 95% interval.");
  if (std::any_of(values.begin(), values.end(), [](const auto& name) { return name.ends_with("_ratio"); }))
    remarks.emplace_back(
        "NAME_ratio: time of the baseline NAME divided by our time in the same rounds, and its 95% interval. Above 1, ours is faster.");
  return remarks;
}

}  // namespace

std::vector<Section> case_sections(const std::vector<Cell>& cells, const std::string& stem,
                                   const Sources& sources) {
  View view = view_of(cells);
  const bool own_view = view != View{};
  // Without a view, an experiment that measures an error or a likeness shows it beside the time, and draws
  // it.
  if (const std::vector<std::string> qualities = qualities_of(cells); !own_view && !qualities.empty()) {
    view.values = {"median_ms"};
    view.values.insert(view.values.end(), qualities.begin(), qualities.end());
    view.y = view.values;
    if (qualities.front().starts_with("error")) {
      view.x = "median_ms";
      view.y = qualities;
      view.x_scale = view.y_scale = "log";
    }
  }
  std::set<std::string> variants, others;
  for (const Cell& c : cells) {
    variants.insert(c.variant);
    others.insert(name_of(c));
  }
  const bool about_variants =
      !own_view && view == View{} && variants.size() >= fewest_variants && others.size() <= most_groups;
  Section section = about_variants ? of_variants(cells, stem, sources) : of_cases(cells, view, stem, sources);
  Table& table = section.table;
  for (const std::string& name : table.layout.values) show_interval(table, name);
  std::vector<std::string> explained = value_remarks(table.layout.values, cells);
  table.remarks.insert(table.remarks.begin(), explained.begin(), explained.end());
  add_remarks(table, {steps_remark(cells)});
  add_remarks(table, mark_remarks(cells));
  add_remarks(table, {drift_remark(cells)});
  section.plots = plots_of(table, cells, view, *sources.notes);
  std::vector<Section> sections{std::move(section)};
  if (std::optional<Table> choices = choices_of(cells)) {
    choices->subtitle = sections.front().table.subtitle;
    choices->stem = stem + "-choices";
    sections.insert(sections.begin(), Section{std::move(*choices), {}});
  }
  return sections;
}

}  // namespace pelage
