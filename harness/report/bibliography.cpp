// Writes references.bib: BibTeX entries of the works to cite together with the report.
#include <fmt/format.h>

#include <map>
#include <set>

#include "harness/report/report.hpp"
#include "harness/version/version.hpp"

namespace pelage {
namespace {

const std::map<std::string, std::string>& papers() {
  static const std::map<std::string, std::string> entries{
      {"banisch2006-grass-and-fur", R"(@article{banisch2006-grass-and-fur,
  author  = {Banisch, Sven and W{\"u}thrich, Charles A.},
  title   = {Making Grass and Fur Move},
  journal = {Journal of WSCG},
  volume  = {14},
  number  = {1--3},
  pages   = {25--32},
  year    = {2006}
}
)"},
      {"demoreuille2011-once-upon-a-monster", R"(@misc{demoreuille2011-once-upon-a-monster,
  author = {Demoreuille, Peter and Franzke, Oliver and Choy, Lydia},
  title  = {Furry, Floppy, Fuzzy: {Once Upon a Monster}'s Fur Pipeline},
  note   = {Double Fine Productions},
  year   = {2011}
}
)"},
      {"silva2010-curling-clumping", R"(@article{silva2010-curling-clumping,
  author  = {Silva, Paulo and Bando, Yosuke and Chen, Bing-Yu and Nishita, Tomoyuki},
  title   = {Curling and Clumping Fur Represented by Texture Layers},
  journal = {The Visual Computer},
  volume  = {26},
  number  = {6--8},
  pages   = {659--667},
  year    = {2010},
  doi     = {10.1007/s00371-010-0484-4}
}
)"},
      {"silva2010-wet-fur", R"(@misc{silva2010-wet-fur,
  author       = {Silva, Paulo and Bando, Yosuke and Chen, Bing-Yu and Nishita, Tomoyuki},
  title        = {Real-Time Rendering of Wet Fur},
  year         = {2010},
  howpublished = {The University of Tokyo, Toshiba and National Taiwan University}
}
)"}};
  return entries;
}

}  // namespace

std::string bibliography_of(const std::vector<FoundRow>& rows) {
  const BuildInfo& build = build_info();
  std::string text = fmt::format(
      "@software{{pelage,\n  title   = {{pelage: an OpenCL research benchmark harness for real-time fur and grass}},\n"
      "  version = {{{}}},\n  note    = {{revision {}}}\n}}\n",
      build.version, build.revision);
  std::set<std::string> experiments, keys;
  for (const FoundRow& found : rows) experiments.insert(found.row.experiment);
  for (const std::string& name : experiments)
    if (const auto experiment = shipped_experiment(name)) keys.insert(experiment->paper);
  for (const std::string& key : keys)
    if (const auto found = papers().find(key); found != papers().end()) text += "\n" + found->second;
  return text;
}

namespace {

/// Returns the scene keys that differ from their defaults (entry `settings` of the provenance): first those
/// that all rows share, then the other keys of each case. Returns "" for rows of earlier versions.
std::string settings_of(const std::vector<const FoundRow*>& rows) {
  std::map<std::string, std::map<std::string, std::string>> cases;  // name of the case -> key -> value
  for (const FoundRow* found : rows) {
    const auto settings = found->row.provenance.value("settings", nlohmann::ordered_json());
    if (!settings.is_object()) continue;
    std::string name = found->row.case_name;
    for (const auto& [key, value] : found->row.overrides) name += fmt::format("; {}={}", key, value);
    for (const auto& [key, value] : settings.items())
      cases[name][key] = value.is_string() ? value.get<std::string>() : value.dump();
  }
  if (cases.empty()) return {};
  std::map<std::string, std::string> shared = cases.begin()->second;
  for (const auto& [name, keys] : cases)
    std::erase_if(shared, [&own = keys](const auto& one) { return found_in(own, one.first) != one.second; });
  std::string text = "  scene keys of all cases that differ from the defaults:\n";
  for (const auto& [key, value] : shared) text += fmt::format("    {} = {}\n", key, value);
  for (const auto& [name, keys] : cases) {
    std::string own;
    for (const auto& [key, value] : keys)
      if (!shared.contains(key)) own += fmt::format("{}{} = {}", own.empty() ? "" : "; ", key, value);
    text += fmt::format("  case {}: {}\n", name, own.empty() ? "no other keys" : own);
  }
  return text;
}

}  // namespace

std::string provenance_of(const std::vector<FoundRow>& rows) {
  // These fields can differ between the rows of one run, and the text describes whole runs.
  static const std::set<std::string> of_a_row{
      "utc",        "started_s",       "cpu_mhz", "cpu_mhz_after", "load",         "prepare_s", "sampling_s",
      "load_after", "other_cpu_share", "check_s", "kernel_hash",   "converged",    "mesh_hash", "scene_hash",
      "check_seed", "bad_input",       "gpu",     "mesh_warnings", "picture_hash", "settings"};
  std::map<std::pair<std::string, std::string>, std::vector<const FoundRow*>> runs;
  for (const FoundRow& found : rows)
    if (found.row.status != Status::skipped)
      runs[{found.row.run_id, found.journal.filename().string()}].push_back(&found);
  std::string text;
  for (const auto& [run, members] : runs) {
    text += fmt::format("run {} ({}, {} rows)\n", run.first, run.second, members.size());
    std::map<std::string, std::set<std::string>> values;
    std::set<std::string> times;
    for (const FoundRow* member : members) {
      for (const auto& [key, value] : member->row.provenance.items())
        if (!of_a_row.contains(key))
          values[key].insert(value.is_string() ? value.get<std::string>() : value.dump());
      if (const std::string utc = provenance_text(member->row, "utc"); !utc.empty()) times.insert(utc);
    }
    if (!times.empty()) text += fmt::format("  from {} to {}\n", *times.begin(), *times.rbegin());
    text += fmt::format("  device: {}\n", members.front()->row.device);
    for (const auto& [key, set] : values) {
      text += fmt::format("  {}:", key);
      for (const std::string& value : set) text += fmt::format(" {}{}", value, set.size() > 1 ? ";" : "");
      text += "\n";
    }
    text += settings_of(members) + "\n";
  }
  return text;
}

}  // namespace pelage
