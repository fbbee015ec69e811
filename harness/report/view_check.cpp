// Checks the columns that the table [report] of an experiment names, before the run.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/error.hpp"
#include "harness/experiment/axes.hpp"
#include "harness/nearest_name.hpp"
#include "harness/report/case_table.hpp"

namespace pelage {

std::vector<std::string> view_warnings(const View& view, const std::map<std::string, std::string>& axes) {
  Cell cell;
  cell.axes = axes;
  std::vector<std::string> known{"triangles"};
  for (const CellColumn& column : case_columns({cell})) known.push_back(column.column.name);
  std::vector<std::string> warnings;
  const auto check = [&](const std::string& key, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      if (is_scene_key(name) && !axes.contains(name)) {
        std::vector<std::string> keys(axes.size());
        std::ranges::transform(axes, keys.begin(), [](const auto& axis) { return axis.first; });
        throw InputError(fmt::format("report.{} names {}, which is no axis of the experiment (its axes: {})",
                                     key, name, fmt::join(keys, ", ")));
      }
      // Short names resemble many columns by chance.
      if (name.size() < 4 || std::find(known.begin(), known.end(), name) != known.end()) continue;
      const std::string near = nearest_name(name, known);
      if (edit_distance(name, near) > 2) continue;
      warnings.push_back(fmt::format(
          "report.{} names the column {}, which is neither an axis nor a time of the table; did you mean {}?",
          key, name, near));
      if (key == "x") throw InputError(warnings.back());
    }
  };
  if (!view.x.empty()) check("x", {view.x});
  for (const auto& [key, member] : view_lists) check(key, view.*member);
  return warnings;
}

}  // namespace pelage
