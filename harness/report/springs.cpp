#include "harness/report/springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "harness/journal/provenance.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

constexpr std::pair<const char*, const char*> charts[] = {
    {"banisch2006-update-time", "Update times of Figures 9 to 11"},
    {"banisch2006-work-precision", "Error against cost, per topology"},
    {"banisch2006-longest-step", "Longest stable step"},
    {"banisch2006-energy", "Energy over time"},
    {"banisch2006-mesh-size", "Cost of a frame's simulation against the size of the mesh"}};

constexpr std::string_view ratio_mark = "_ratio", processor_mark = "_processor_ratio";

std::string of(const std::map<std::string, std::string>& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? std::string() : found->second;
}

}  // namespace

std::vector<SpringsChart> springs_charts(const std::vector<FoundRow>& rows) {
  std::vector<SpringsChart> found;
  for (const auto& [experiment, title] : charts) {
    std::map<std::string, std::vector<FoundRow>> by_device;
    for (const FoundRow& one : rows)
      if (one.row.experiment == experiment && one.row.overrides.empty())
        by_device[one.row.device].push_back(one);
    for (auto& [device, own] : by_device) {
      if (std::none_of(own.begin(), own.end(), [](const FoundRow& r) { return r.row.status == Status::ok; }))
        continue;
      const bool several = by_device.size() > 1;
      found.push_back({several ? fmt::format("{}, {}", title, device) : title,
                       several ? fmt::format("{}@{}", experiment, file_name_of(device)) : experiment,
                       std::move(own)});
    }
  }
  return found;
}

std::vector<SolverLine> solver_lines(const std::vector<FoundRow>& rows) {
  std::vector<SolverLine> lines;
  for (const auto& [row, journal, copies] : rows) {
    if (row.experiment != "topology-solvers" || row.status != Status::ok || !row.overrides.empty()) continue;
    for (const auto& [name, metric] : row.metrics) {
      if (!name.ends_with(ratio_mark) || name.ends_with(processor_mark)) continue;
      SolverLine line{of(row.axes, "model"),
                      of(row.axes, "dynamics.topology"),
                      row.variant,
                      of(row.axes, "dynamics.substeps"),
                      row.device,
                      name.substr(0, name.size() - ratio_mark.size())};
      line.ratio = metric.value;
      line.low = metric.low.value_or(metric.value), line.high = metric.high.value_or(metric.value);
      line.ours_ms = median(frame_ms(row));
      if (const auto theirs = row.samples.find(line.rival); theirs != row.samples.end())
        line.rival_ms = median(theirs->second.wall_ms);
      if (const auto shared = row.metrics.find(line.rival + std::string(processor_mark));
          shared != row.metrics.end())
        line.processor_ratio = shared->second.value;
      lines.push_back(std::move(line));
    }
  }
  std::stable_sort(lines.begin(), lines.end(), [](const SolverLine& a, const SolverLine& b) {
    return std::tie(a.device, a.model, a.topology, a.solver, a.substeps, a.rival) <
           std::tie(b.device, b.model, b.topology, b.solver, b.substeps, b.rival);
  });
  return lines;
}

std::string csv_of(const std::vector<SolverLine>& lines) {
  std::string text =
      csv_line({"device", "model", "topology", "solver", "substeps", "median_ms", "rival", "rival_median_ms",
                "ratio", "ratio_low", "ratio_high", "ratio_by_processor_time"});
  const auto number = [](double value) { return value > 0 ? fmt::format("{:.6g}", value) : std::string(); };
  for (const SolverLine& l : lines)
    text += csv_line({l.device, l.model, l.topology, l.solver, l.substeps, number(l.ours_ms), l.rival,
                      number(l.rival_ms), number(l.ratio), number(l.low), number(l.high),
                      number(l.processor_ratio)});
  return text;
}

std::string html_of(const std::vector<SolverLine>& lines) {
  if (lines.empty()) return {};
  std::string html =
      "<h2>Mass-spring solvers against serial C++ and Eigen</h2>\n<p class=\"soft\">A launch of so many "
      "steps by ours and "
      "by each rival, all from one state, in turns; <a href=\"tables/topology-solvers-ratios.csv\">CSV</a>. "
      "Ratio: "
      "the rival's "
      "time by ours, the median over rounds with its 95% interval. By processor time: the rival's by ours "
      "shared by all "
      "cores, which other work on the machine does not move. serial-o3: C++ at -O3; serial-fast: -O3 "
      "-march=native "
      "-ffast-math, floats both unless it says double; eigen-...-1, -2: threads, -O3 -march=native.</p>\n"
      "<div class=\"wide\"><table>\n<thead><tr><th>Model</th><th>Topology</th><th>Solver</th><th>Steps</th>"
      "<th>ours, ms</th><th>Rival</th><th>its, ms</th><th>ratio</th><th>95%</th><th>by processor "
      "time</th></tr></thead>\n"
      "<tbody>\n";
  const SolverLine* before = nullptr;
  for (const SolverLine& l : lines) {
    const bool same =
        before && std::tie(before->device, before->model, before->topology, before->solver,
                           before->substeps) == std::tie(l.device, l.model, l.topology, l.solver, l.substeps);
    html +=
        same ? "<tr><td></td><td></td><td></td><td></td><td></td>"
             : fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"ours\">{:.4g}</td>",
                           l.model, l.topology, l.solver, l.substeps, l.ours_ms);
    html += fmt::format(
        "<td>{}</td><td>{:.4g}</td><td class=\"ours\">{:.3g}</td><td>{:.3g} to {:.3g}</td><td>{}</td></tr>\n",
        l.rival, l.rival_ms, l.ratio, l.low, l.high,
        l.processor_ratio > 0 ? fmt::format("{:.3g}", l.processor_ratio) : "–");
    before = &l;
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace pelage
