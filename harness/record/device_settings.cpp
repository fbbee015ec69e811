#include "harness/record/device_settings.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace pelage {
namespace {

using Settings = std::map<std::string, std::string>;

/// Keys of the provenance, the most telling first. With a number of threads, PoCL's compute units change too.
constexpr const char* keys[] = {"compute_units", "usable_cores", "cpu_quota",        "lanes",
                                "pocl_affinity", "platform",     "platform_version", "driver",
                                "device_version"};

std::string text_of(const nlohmann::ordered_json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Returns the names of the settings in this order: `keys`, then environment variables.
std::vector<std::string> names_in(const std::vector<FoundRow*>& rows) {
  std::vector<std::string> names(std::begin(keys), std::end(keys));
  std::set<std::string> variables;
  for (const FoundRow* found : rows)
    if (const auto own = found->row.provenance.find("environment");
        own != found->row.provenance.end() && own->is_object())
      for (const auto& [name, value] : own->items()) variables.insert(name);
  names.insert(names.end(), variables.begin(), variables.end());
  return names;
}

std::string setting_of(const Row& row, const std::string& name) {
  const auto& provenance = row.provenance;
  if (const auto own = provenance.find(name); own != provenance.end()) return text_of(*own);
  if (const auto variables = provenance.find("environment");
      variables != provenance.end() && variables->is_object())
    if (const auto own = variables->find(name); own != variables->end()) return text_of(*own);
  return "unset";
}

/// Returns the rows with equal names: the same case, variant, overrides and axes.
std::map<std::vector<std::string>, std::vector<FoundRow*>> by_name(const std::vector<FoundRow*>& rows) {
  std::map<std::vector<std::string>, std::vector<FoundRow*>> named;
  for (FoundRow* found : rows) {
    std::vector<std::string> name{found->row.case_name, found->row.variant};
    for (const Settings* part : {&found->row.overrides, &found->row.axes})
      for (const auto& [key, value] : *part) name.insert(name.end(), {key, value});
    named[std::move(name)].push_back(found);
  }
  return named;
}

/// Whether the setting has several values among rows with equal names and several identities.
bool tells_apart(const std::vector<FoundRow*>& rows, const std::string& setting) {
  return std::ranges::any_of(by_name(rows), [&](const auto& named) {
    const std::vector<FoundRow*>& equal = named.second;
    return std::ranges::any_of(equal, [&](const FoundRow* found) {
      return found->row.identity != equal.front()->row.identity &&
             setting_of(found->row, setting) != setting_of(equal.front()->row, setting);
    });
  });
}

/// Whether rows with equal names differ in no other part of the identity than "device".
bool differ_in_the_device_alone(const std::vector<FoundRow*>& rows) {
  return std::ranges::all_of(by_name(rows), [](const auto& named) {
    return std::ranges::all_of(named.second, [&](const FoundRow* found) {
      const std::vector<std::string> parts =
          differing_parts(named.second.front()->row.identity, found->row.identity);
      return parts.empty() || parts == std::vector<std::string>{"device"};
    });
  });
}

}  // namespace

bool is_device_setting(const std::string& axis) {
  return std::ranges::find(keys, axis) != std::end(keys) || axis.starts_with("POCL_");
}

void add_settings_as_axes(std::vector<FoundRow>& rows) {
  std::map<std::vector<std::string>, std::vector<FoundRow*>> groups;
  for (FoundRow& found : rows)
    groups[{found.row.experiment, found.row.device, provenance_text(found.row, "host")}].push_back(&found);
  for (const auto& [unused, group] : groups) {
    if (!differ_in_the_device_alone(group)) continue;
    for (const std::string& name : names_in(group)) {
      if (!tells_apart(group, name)) continue;
      for (FoundRow* found : group) found->row.axes[name] = setting_of(found->row, name);
    }
  }
}

}  // namespace pelage
