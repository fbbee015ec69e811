#include "harness/page/chart.hpp"

#include <algorithm>
#include <set>

#include "harness/base/numbers.hpp"

namespace pelage {
namespace {

using Names = std::vector<std::string>;
using Line = std::vector<Value>;

/// Access to a table's values by the names of its columns.
class Columns {
 public:
  explicit Columns(const Table& table) : table_(table) {}

  const Value& value(const Line& line, const std::string& column) const {
    return line[std::size_t(column_of(table_, column))];
  }

  /// Returns the number in this line and column of the table, or nothing if the value is not a number or the
  /// table has no such column.
  std::optional<double> number(const Line& line, const std::string& column) const {
    const int index = column_of(table_, column);
    return index < 0 ? std::nullopt : number_of(line[std::size_t(index)].data);
  }

  Names values(const Line& line, const Names& columns) const {
    Names result;
    for (const std::string& column : columns) result.push_back(value(line, column).data);
    return result;
  }

  /// Returns the combinations of values of `columns` that occur in the table, sorted by precedes(). Returns
  /// one empty combination if `columns` is empty.
  std::vector<Names> combinations(const Names& columns) const {
    std::set<Names> found;
    for (const Line& line : table_.lines) found.insert(values(line, columns));
    std::vector<Names> result(found.begin(), found.end());
    std::stable_sort(result.begin(), result.end(), [&](const Names& a, const Names& b) {
      for (std::size_t i = 0; i < columns.size(); ++i)
        if (a[i] != b[i]) return precedes(column(columns[i]), a[i], b[i]);
      return false;
    });
    return result;
  }

  std::string label(const Names& columns, const Names& values) const {
    std::string text;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i] == "reading" && values[i] == "default") continue;
      const std::string part = with_value(column(columns[i]), values[i]);
      if (part.empty()) continue;
      if (!text.empty()) text += ", ";
      text += part;
    }
    return text;
  }

  const Column& column(const std::string& name) const {
    return table_.columns[std::size_t(column_of(table_, name))];
  }

 private:
  const Table& table_;
};

/// Returns the distinct values of column `x`, sorted by Column::order. If the column has no such order, the
/// values keep the order in which they occur in the table.
Names categories_of(const Table& table, const Columns& columns, const std::string& x) {
  Names names;
  for (const Line& line : table.lines)
    if (const std::string& name = columns.value(line, x).data;
        std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  const Names& order = columns.column(x).order;
  std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return std::find(order.begin(), order.end(), a) < std::find(order.begin(), order.end(), b);
  });
  return names;
}

/// Returns the x coordinate of the chart point that represents `line`, a line of the table. If there are
/// categories, the coordinate is the index of the line's category. Otherwise it is the number in column
/// plot.x, or nothing if the line has no number in this column.
std::optional<double> x_of(const Columns& columns, const Line& line, const PlotSpec& plot,
                           const Names& categories) {
  if (categories.empty()) return columns.number(line, plot.x);
  const auto place = std::find(categories.begin(), categories.end(), columns.value(line, plot.x).data);
  return double(place - categories.begin());
}

/// Returns the chart point that represents `line`, a line of the table. The column `y` contains the point's y
/// coordinate. The columns `low` and `high` contain the limits of its error bar.
std::optional<ChartPoint> point_of(const Columns& columns, const Line& line, std::optional<double> x,
                                   const std::string& y, const std::string& low, const std::string& high) {
  const std::optional<double> value = columns.number(line, y);
  if (!x || !value) return {};
  return ChartPoint{*x, *value, columns.number(line, low), columns.number(line, high),
                    columns.value(line, y).cell};
}

void sort_points(ChartLine& line) {
  std::stable_sort(line.points.begin(), line.points.end(),
                   [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
}

bool repeats_x(const ChartLine& line) {
  return std::adjacent_find(line.points.begin(), line.points.end(),
                            [](const auto& a, const auto& b) { return a.x == b.x; }) != line.points.end();
}

}  // namespace

Chart chart_of(const Table& table, const PlotSpec& plot) {
  const Columns columns(table);
  Chart chart;
  chart.title = plot.title, chart.note = plot.note, chart.stem = plot.stem;
  chart.x_label = plot.x_label, chart.x_scale = plot.x_scale;
  chart.y_label = plot.y_label, chart.y_scale = plot.y_scale;
  chart.guide = plot.guide;
  const bool numeric = std::all_of(table.lines.begin(), table.lines.end(), [&](const Line& line) {
    return columns.value(line, plot.x).data.empty() || columns.number(line, plot.x);
  });
  if (!numeric) chart.categories = categories_of(table, columns, plot.x), chart.x_scale = "linear";

  for (const Names& of_panel : columns.combinations(plot.panels)) {
    ChartPanel panel{columns.label(plot.panels, of_panel), "", {}};
    for (const Names& of_line : columns.combinations(plot.series)) {
      const std::string label = columns.label(plot.series, of_line);
      ChartLine ours{label, label, numeric ? Mark::line : Mark::points, {}},
          theirs{label, label, Mark::published, {}};
      if (!plot.published.empty()) {
        ours.label = label.empty() ? "ours" : "ours, " + label;
        theirs.label = label.empty() ? plot.published_label : plot.published_label + ", " + label;
      }
      for (const Line& line : table.lines) {
        if (columns.values(line, plot.panels) != of_panel || columns.values(line, plot.series) != of_line)
          continue;
        const auto x = x_of(columns, line, plot, chart.categories);
        if (auto point = point_of(columns, line, x, plot.y, plot.low, plot.high))
          ours.points.push_back(*point);
        if (plot.published.empty()) continue;
        if (auto point =
                point_of(columns, line, x, plot.published, plot.published + "_low", plot.published + "_high"))
          theirs.points.push_back(*point);
      }
      for (ChartLine* line : {&ours, &theirs}) {
        sort_points(*line);
        if (repeats_x(*line) && line->mark == Mark::line) line->mark = Mark::points;
        if (!line->points.empty()) panel.lines.push_back(std::move(*line));
      }
    }
    if (!panel.lines.empty()) chart.panels.push_back(std::move(panel));
  }
  return chart;
}

nlohmann::ordered_json json_of(const Chart& chart) {
  using Json = nlohmann::ordered_json;
  const auto optional = [](const std::optional<double>& number) { return number ? Json(*number) : Json(); };
  Json panels = Json::array();
  for (const ChartPanel& panel : chart.panels) {
    Json lines = Json::array();
    for (const ChartLine& line : panel.lines) {
      Json points = Json::array();
      for (const ChartPoint& p : line.points)
        points.push_back({p.x, p.y, optional(p.low), optional(p.high), p.cell});
      const char* marks[] = {"points", "line", "published"};
      lines.push_back({{"label", line.label},
                       {"key", line.key},
                       {"mark", marks[int(line.mark)]},
                       {"points", std::move(points)}});
    }
    panels.push_back({{"title", panel.title},
                      {"xLabel", panel.x_label.empty() ? chart.x_label : panel.x_label},
                      {"lines", std::move(lines)}});
  }
  return {{"title", chart.title},
          {"note", chart.note},
          {"stem", chart.stem},
          {"xScale", chart.x_scale},
          {"yLabel", chart.y_label},
          {"yScale", chart.y_scale},
          {"categories", chart.categories},
          {"guide", optional(chart.guide)},
          {"panels", std::move(panels)}};
}

}  // namespace pelage
