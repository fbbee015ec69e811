// pelage list: lists the experiments and their presets, or the cases of one experiment.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "harness/commands/commands.hpp"
#include "harness/commands/progress.hpp"
#include "harness/experiment/experiment.hpp"

namespace pelage {
namespace {

using Json = nlohmann::ordered_json;

struct ListOptions {
  std::string experiment, preset = "quick";
  bool json = false;
};

/// Returns an upper limit of the time for sampling all cases of the preset, in seconds. The preparation of
/// meshes and textures and the checks of the pictures take additional time.
double most_seconds(const Experiment& experiment, const Preset& preset) {
  return double(cases_of(experiment, preset).size()) * (preset.limits.warm_up_s + preset.limits.limit_s);
}

/// Returns " (PAPER, TABLE)", the source of the experiment. Omits PAPER or TABLE if the experiment file
/// does not give it. Returns "" if the file gives neither of them.
std::string source_of(const Experiment& experiment) {
  if (experiment.paper.empty() && experiment.table.empty()) return "";
  const char* between = experiment.paper.empty() || experiment.table.empty() ? "" : ", ";
  return fmt::format(" ({}{}{})", experiment.paper, between, experiment.table);
}

/// Returns ", collection NAME", or "" if the experiment belongs to no collection.
std::string collection_of(const Experiment& experiment) {
  return experiment.collection.empty() ? "" : fmt::format(", collection {}", experiment.collection);
}

int list_all(bool json) {
  Json list = Json::array();
  for (const auto& file : experiment_files()) {
    const Experiment e = read_experiment(file);
    Json presets = Json::object();
    if (!json) fmt::print("{}\n  {}{}{}\n", e.name, e.title, source_of(e), collection_of(e));
    for (const auto& [name, preset] : e.presets) {
      const std::size_t count = cases_of(e, preset).size();
      presets[name] = {{"cases", count},
                       {"least_samples", preset.limits.least},
                       {"most_samples", preset.limits.most},
                       {"sampling_at_most_s", most_seconds(e, preset)}};
      if (!json)
        fmt::print("  {:8} {:3} cases, {} to {} samples each, sampling takes at most {}\n", name, count,
                   preset.limits.least, preset.limits.most, clock_text(most_seconds(e, preset)));
    }
    list.push_back({{"name", e.name},
                    {"title", e.title},
                    {"paper", e.paper},
                    {"table", e.table},
                    {"collection", e.collection},
                    {"file", file.string()},
                    {"presets", presets}});
  }
  if (json) fmt::print("{}\n", list.dump(2));
  return 0;
}

std::string figure_text(const Metric& figure) {
  const std::string relation = figure.relation == "=" ? "" : figure.relation + " ";
  return fmt::format("{}{} {}", relation, figure.value, figure.unit);
}

int list_cases(const ListOptions& options) {
  const Experiment e = read_experiment(experiment_file(options.experiment));
  Json list = Json::array();
  for (const Case& c : cases_of(e, preset_of(e, options.preset))) {
    const std::string paper = c.published ? figure_text(*c.published) : "";
    if (options.json) {
      list.push_back({{"case", c.name}, {"variant", c.variant}, {"axes", c.axes}, {"paper", paper}});
    } else {
      fmt::print("{:36} {:14} {}\n", c.name, c.variant, paper.empty() ? "" : "paper: " + paper);
    }
  }
  if (options.json) fmt::print("{}\n", list.dump(2));
  return 0;
}

int list(const ListOptions& options) {
  return options.experiment.empty() ? list_all(options.json) : list_cases(options);
}

}  // namespace

void add_list(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<ListOptions>(
      app, chosen, "list", "List the experiments, or the cases of one experiment", list);
  command
      .add_option("experiment", options.experiment, "Experiment whose cases are listed: a name, or FILE.toml")
      ->type_name("EXPERIMENT|FILE.toml");
  command.add_option("--preset", options.preset, "Preset whose cases are listed")
      ->type_name("NAME")
      ->capture_default_str();
  command.add_flag("--json", options.json, "Print JSON");
}

}  // namespace pelage
