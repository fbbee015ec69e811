// The layout of the report of an experiment: its tables and plots. The table [report] of the experiment file
// defines it. Each row (the recorded result of a case) contains a copy of the layout, so that a report does
// not need the experiment file. docs/results.md describes the keys.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace pelage {

/// The members `blocks` to `panels` contain names of columns of the case table
/// (harness/report/case_table.hpp). A column is an axis, "fps", "median_ms", the time of a phase such as
/// "simulate_ms", or a metric. If a member is empty, the report chooses columns itself.
struct View {
  /// These members define the cross tables of the report. There is one cross table for each combination of
  /// values of the case table's columns in `blocks`. In a cross table, each combination of values of the
  /// columns in `columns` has its own group of columns. The cells show the numbers of the columns in
  /// `values`.
  std::vector<std::string> blocks = {}, columns = {}, values = {};
  std::string x = {};               ///< column on the horizontal axis of all plots
  std::vector<std::string> y = {};  ///< columns on the vertical axis; each column gives one plot
  std::vector<std::string> series = {}, panels = {};
  std::string x_scale = {}, y_scale = {};  ///< "linear" or "log"
  std::string program = {};  ///< name of a program in plots/ that draws a plot only for this experiment
  bool operator==(const View&) const = default;
};

nlohmann::json to_json(const View& view);

/// Returns the view that to_json() wrote. Ignores unknown members and members of a wrong type, because a user
/// may have edited the rows.
View view_from_json(const nlohmann::json& json);

}  // namespace pelage
