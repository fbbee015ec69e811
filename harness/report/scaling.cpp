#include "harness/report/scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "harness/report/csv.hpp"

namespace pelage {
namespace {

constexpr double most_for_doubling = 2.05, most_for_64_by_16 = 3.3;

double metric(const Cell& cell, const std::string& name) {
  const auto found = cell.metrics.find(name);
  return found == cell.metrics.end() ? 0 : found->second.value;
}

int layers_of(const Cell& cell) {
  return std::atoi(cell.axis("layers").c_str());
}

std::array<int, 2> size_of(const Cell& cell) {
  const std::string size = cell.axis("size");
  const auto cross = size.find('x');
  return {std::atoi(size.c_str()), cross == std::string::npos ? 0 : std::atoi(size.c_str() + cross + 1)};
}

/// The same case with another number of layers; null when there is none.
const Cell* with_layers(const std::vector<Cell>& cells, const Cell& like, int layers) {
  const auto found = std::find_if(cells.begin(), cells.end(), [&](const Cell& c) {
    return c.device == like.device && c.host == like.host && c.variant == like.variant &&
           c.axis("model") == like.axis("model") && c.axis("size") == like.axis("size") &&
           layers_of(c) == layers;
  });
  return found == cells.end() ? nullptr : &*found;
}

}  // namespace

std::vector<Cell> scaling_cells(const std::vector<Cell>& cells) {
  std::vector<Cell> result;
  for (const Cell& c : cells)
    if (c.experiment == "scaling" && c.overrides.empty() && c.median_ms > 0 && metric(c, "triangles") > 0 &&
        layers_of(c) > 0 && size_of(c)[1] > 0)
      result.push_back(c);
  return result;
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
  double worst_double = 0, worst_64 = 0;
  for (const Cell& c : cells) {
    if (const Cell* twice = with_layers(cells, c, 2 * layers_of(c))) {
      const double ratio = twice->median_ms / c.median_ms;
      text += fmt::format("{:<20} {:>9}  {:>3} -> {:>3} layers: {:>9.2f} -> {:>9.2f} ms, {:.2f} times\n",
                          c.axis("model"), c.axis("size"), layers_of(c), layers_of(*twice), c.median_ms,
                          twice->median_ms, ratio);
      worst_double = std::max(worst_double, ratio);
    }
    if (const Cell* more = with_layers(cells, c, 64); more && layers_of(c) == 16)
      worst_64 = std::max(worst_64, more->median_ms / c.median_ms);
  }
  if (worst_double > 0)
    text += fmt::format("Doubling the layers costs at most {:.2f} times (wanted: at most {:.2f})\n",
                        worst_double, most_for_doubling);
  if (worst_64 > 0)
    text += fmt::format("64 layers cost at most {:.2f} times 16 (wanted: at most {:.1f})\n", worst_64,
                        most_for_64_by_16);
  const auto largest = std::max_element(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
    return metric(a, "peak_memory") < metric(b, "peak_memory");
  });
  if (largest != cells.end() && metric(*largest, "peak_memory") > 0)
    text += fmt::format("Most memory: {:.0f} MiB, {}\n", metric(*largest, "peak_memory") / (1 << 20),
                        largest->case_name);
  return text;
}

}  // namespace pelage
