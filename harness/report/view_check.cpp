#include "harness/report/view_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/nearest_name.hpp"
#include "harness/report/case_table.hpp"

namespace pelage {

std::vector<std::string> view_warnings(const View& view, const std::map<std::string, std::string>& axes) {
  Cell cell;
  cell.axes = axes;
  std::vector<std::string> known{"triangles"};
  for (const CellColumn& column : case_columns({cell})) known.push_back(column.column.name);
  std::vector<std::string> warnings;
  const auto check = [&](const char* key, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      // Short names resemble many columns by chance.
      const std::string near = name.size() < 4 ? "" : nearest_name(name, known);
      if (near.empty() || edit_distance(name, near) > 2) continue;
      warnings.push_back(fmt::format(
          "report.{} names the column {}, which is neither an axis nor a time of the table; did you mean {}?",
          key, name, near));
    }
  };
  check("blocks", view.blocks);
  check("columns", view.columns);
  check("values", view.values);
  if (!view.x.empty()) check("x", {view.x});
  check("y", view.y);
  check("series", view.series);
  check("panels", view.panels);
  return warnings;
}

}  // namespace pelage
