// How the report shows the rows of an experiment: the keys of the table [report] in the experiment's file.
// The provenance of each row contains these keys, so that a report does not need the experiment file.
// docs/results.md describes the keys.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace pelage {

/// Names of columns of the table with one line per case (harness/report/case_table.hpp): an axis, "fps",
/// "median_ms", a phase such as "simulate_ms", or a metric. If a member is empty, the report chooses.
struct View {
  std::vector<std::string> blocks = {}, columns = {},
                           values = {};  ///< for separate tables, groups of columns, and numbers
  std::string x = {};                    ///< horizontal axis of the plots
  std::vector<std::string> y = {};       ///< vertical axes; each gives one plot
  std::vector<std::string> series = {}, panels = {};
  std::string x_scale = {}, y_scale = {};  ///< "linear" or "log"
  std::string program = {};  ///< name of a program in plots/ that draws the experiment's own plot
  bool operator==(const View&) const = default;
};

nlohmann::json to_json(const View& view);

/// Reads what to_json() wrote. Ignores unknown members and members of a wrong type, because a user may have
/// edited the rows.
View view_from_json(const nlohmann::json& json);

}  // namespace pelage
