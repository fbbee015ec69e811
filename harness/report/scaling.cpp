#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <tuple>

#include "harness/base/numbers.hpp"
#include "harness/report/case_table.hpp"
#include "harness/report/report.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

constexpr double most_for_doubling = 2.05, most_for_64_by_16 = 3.3;

double metric(const Cell& cell, const std::string& name) {
  const Metric* found = cell.metric(name);
  return found ? found->value : 0;
}

int layers_of(const Cell& cell) {
  return std::atoi(cell.axis("layers").c_str());
}

std::array<int, 2> size_of(const Cell& cell) {
  const Size size = size_from_text(cell.axis("size")).value_or(Size{});
  return {size.width, size.height};
}

}  // namespace

std::vector<Cell> scaling_cells(const std::vector<Cell>& cells) {
  std::map<std::string, bool> chosen;  // experiment -> whether its report.program is "scaling"
  std::map<std::string, std::vector<Cell>> by_changes;
  for (const Cell& c : cells) {
    const auto [place, added] = chosen.try_emplace(c.experiment);
    if (added) place->second = view_of({c}).program == "scaling";
    if (place->second && c.median_ms > 0 && metric(c, "triangles") > 0 && layers_of(c) > 0 &&
        size_from_text(c.axis("size")))
      by_changes[changes_of(c.overrides)].push_back(c);
  }
  const auto most =
      std::ranges::max_element(by_changes, {}, [](const auto& group) { return group.second.size(); });
  return most == by_changes.end() ? std::vector<Cell>{} : most->second;
}

std::string scaling_csv(const std::vector<Cell>& cells) {
  std::string text = csv_line({"device", "case", "model", "triangles", "layers", "width", "height",
                               "median_ms", "median_ms_low", "median_ms_high", "peak_memory_bytes"});
  for (const Cell& c : cells) {
    const auto [width, height] = size_of(c);
    text += csv_line({c.device, c.case_name, c.axis("model"), fmt::format("{:.0f}", metric(c, "triangles")),
                      c.axis("layers"), std::to_string(width), std::to_string(height),
                      fmt::format("{:.6g}", c.median_ms), fmt::format("{:.6g}", c.interval_ms.low),
                      fmt::format("{:.6g}", c.interval_ms.high),
                      fmt::format("{:.0f}", metric(c, "peak_memory"))});
  }
  return text;
}

std::string scaling_text(const std::vector<Cell>& cells) {
  std::string text;
  std::vector<double> doubled, by_16;
  for (const Cell& c : cells) {
    if (const Cell* twice = counterpart(cells, c, "layers", std::to_string(2 * layers_of(c)))) {
      const double ratio = twice->median_ms / c.median_ms;
      text += fmt::format("{:<20} {:>9}  {:>3} -> {:>3} layers: {:>9.2f} -> {:>9.2f} ms, {:.2f} times\n",
                          c.axis("model"), c.axis("size"), layers_of(c), layers_of(*twice), c.median_ms,
                          twice->median_ms, ratio);
      doubled.push_back(ratio);
    }
    if (const Cell* more = counterpart(cells, c, "layers", "64"); more && layers_of(c) == 16)
      by_16.push_back(more->median_ms / c.median_ms);
  }
  if (!doubled.empty())
    text += fmt::format("A frame with twice the layers takes at most {:.2f} times as long (limit: {:.2f})\n",
                        std::ranges::max(doubled), most_for_doubling);
  if (!by_16.empty())
    text += fmt::format("64 layers take at most {:.2f} times the time of 16 layers (limit: {:.1f})\n",
                        std::ranges::max(by_16), most_for_64_by_16);
  const auto largest =
      std::ranges::max_element(cells, {}, [](const Cell& c) { return metric(c, "peak_memory"); });
  if (largest != cells.end() && metric(*largest, "peak_memory") > 0)
    text += fmt::format("Most memory: {:.0f} MiB, {}\n", metric(*largest, "peak_memory") / (1 << 20),
                        largest->case_name);
  return text;
}

std::vector<Cell> in_turns_cells(const std::vector<Cell>& cells) {
  std::vector<Cell> result;
  for (const Cell& c : cells)
    if (c.status == Status::ok && c.metrics.contains("frame_over_half") &&
        c.metrics.contains("frame_over_quarter"))
      result.push_back(c);
  std::ranges::sort(result, {}, [](const Cell& c) {
    return std::tuple(c.device, metric(c, "triangles"), c.axis("model"), layers_of(c), size_of(c));
  });
  return result;
}

std::string in_turns_csv(const std::vector<Cell>& cells) {
  std::string text =
      csv_line({"device", "model", "triangles", "layers", "size", "median_ms", "frame_over_half", "half_low",
                "half_high", "frame_over_quarter", "quarter_low", "quarter_high"});
  for (const Cell& c : cells) {
    std::vector<std::string> line{
        c.device,         c.axis("model"), fmt::format("{:.0f}", metric(c, "triangles")),
        c.axis("layers"), c.axis("size"),  fmt::format("{:.6g}", c.median_ms)};
    for (const char* name : {"frame_over_half", "frame_over_quarter"}) {
      const Metric& ratio = c.metrics.at(name);
      for (const double value :
           {ratio.value, ratio.low.value_or(ratio.value), ratio.high.value_or(ratio.value)})
        line.push_back(fmt::format("{:.4g}", value));
    }
    text += csv_line(line);
  }
  return text;
}

std::string in_turns_text(const std::vector<Cell>& cells) {
  if (cells.empty()) return {};
  std::string text =
      "Frame time divided by the frame times with half and with a quarter of the layers: median over the rounds [95% interval]\n";
  const auto shown = [](const Metric& m) { return fmt::format("{:.2f}{}", m.value, interval_text(m)); };
  std::vector<double> half, quarter;
  for (const Cell& c : cells) {
    const Metric &by_half = c.metrics.at("frame_over_half"), &by_quarter = c.metrics.at("frame_over_quarter");
    text += fmt::format("{:<14}{:>9.0f} triangles {:>10} {:>4} layers:  {:<20}  {}\n", c.axis("model"),
                        metric(c, "triangles"), c.axis("size"), c.axis("layers"), shown(by_half),
                        shown(by_quarter));
    half.push_back(by_half.value);
    quarter.push_back(by_quarter.value);
  }
  return text +
         fmt::format(
             "A frame with twice the layers takes at most {:.2f} times as long (limit: {:.2f}); a frame with four times the layers takes at most {:.2f} times as long (limit: {:.1f})\n",
             std::ranges::max(half), most_for_doubling, std::ranges::max(quarter), most_for_64_by_16);
}

}  // namespace pelage
