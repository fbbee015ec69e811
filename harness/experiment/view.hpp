// How the report shows the rows of an experiment: the keys of [report] of the experiment's file. Each row's
// provenance contains them, so that a report needs no experiment file. docs/results.md describes the keys.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace pelage {

/// Names of columns of the table with one line per case: an axis, "fps", "median_ms", a phase such as
/// "simulate_ms", or a metric. An empty member means: the report chooses.
struct View {
  std::vector<std::string> blocks = {}, columns = {},
                           values = {};  ///< separate tables, groups of columns, shown numbers
  std::string x = {};                    ///< horizontal axis of the plots
  std::vector<std::string> y = {};       ///< vertical axes; each has a plot
  std::vector<std::string> series = {}, panels = {};
  std::string x_scale = {}, y_scale = {};  ///< "linear" or "log"
  std::string program = {};  ///< name of a program in plots/ that draws the experiment's own plot
  bool operator==(const View&) const = default;
};

nlohmann::json to_json(const View& view);

/// Reads what to_json() wrote. Ignores unknown members and members of another type: rows are not trusted.
View view_from_json(const nlohmann::json& json);

}  // namespace pelage
