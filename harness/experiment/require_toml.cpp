#include "harness/experiment/require_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "harness/experiment/toml_values.hpp"
#include "harness/record/ratios.hpp"

namespace pelage {

namespace fs = std::filesystem;

namespace {

/// Returns the least values of metrics in a table. Tables in it are ignored.
std::map<std::string, double> least_values(const fs::path& file, const toml::table& table) {
  std::map<std::string, double> result;
  for (const auto& [metric, node] : table)
    if (!node.is_table())
      result[present_metric(std::string(metric.str()), file.string())] =
          number_at(file, table, metric.str(), 0, -1e300, 1e300);
  return result;
}

}  // namespace

void read_require(const fs::path& file, const toml::table& table, Experiment& into) {
  into.require = least_values(file, table);
  for (const auto& [axis, node] : table) {
    if (!node.is_table()) continue;
    for (const auto& [value, inner] : *node.as_table()) {
      if (!inner.is_table())
        refuse(file, &inner,
               fmt::format("require.{}.{} must be a table of metrics and least values", axis.str(),
                           value.str()));
      into.require_at[std::string(axis.str())][std::string(value.str())] =
          least_values(file, *inner.as_table());
    }
  }
}

void check_require(const fs::path& file, const toml::table& table, const Experiment& experiment) {
  const auto known = [&](const std::string& axis, const std::string& value) {
    const auto has = [&](const std::vector<Axis>& axes) {
      return std::any_of(axes.begin(), axes.end(), [&](const Axis& one) {
        return one.key == axis && std::find(one.values.begin(), one.values.end(), value) != one.values.end();
      });
    };
    return has(experiment.axes) || std::any_of(experiment.presets.begin(), experiment.presets.end(),
                                               [&](const auto& preset) { return has(preset.second.axes); });
  };
  for (const auto& [axis, values] : experiment.require_at)
    for (const auto& [value, least] : values)
      if (!known(axis, value))
        refuse(file, table.get("require"),
               fmt::format("require.{}.{}: no axis has this name and value", axis, value));
}

}  // namespace pelage
