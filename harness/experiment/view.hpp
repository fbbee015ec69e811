// The layout of the report of an experiment: its table [report] (docs/results.md). Each row contains a copy
// of it, so that a report does not need the experiment file.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace pelage {

/// The members `blocks` to `panels` contain names of columns of the case table
/// (harness/report/case_table.hpp). If a member is empty, the report chooses columns itself.
struct View {
  /// The cross tables: one for each combination of values of `blocks`, with a group of columns for each
  /// combination of values of `columns`. The cells show the numbers of `values`.
  std::vector<std::string> blocks = {}, columns = {}, values = {};
  std::string x = {};               ///< column on the horizontal axis of all plots
  std::vector<std::string> y = {};  ///< columns on the vertical axis; each column gives one plot
  std::vector<std::string> series = {}, panels = {};
  std::string x_scale = {}, y_scale = {};  ///< "linear" or "log"
  std::string marks = {};    ///< "bars": plots with categories on the horizontal axis have bars; else points
  std::string program = {};  ///< name of a program in plots/ that draws a plot only for this experiment
  bool operator==(const View&) const = default;
};

/// The lists of names of columns, and their keys.
inline constexpr std::pair<const char*, std::vector<std::string> View::*> view_lists[] = {
    {"blocks", &View::blocks}, {"columns", &View::columns}, {"values", &View::values},
    {"y", &View::y},           {"series", &View::series},   {"panels", &View::panels}};

nlohmann::json to_json(const View& view);

/// Returns the view that to_json() wrote. Ignores unknown members and wrong types: a user may have edited the
/// rows.
View view_from_json(const nlohmann::json& json);

}  // namespace pelage
