#include "harness/experiment/paper_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/base/toml_table.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// Calls `read` for each table of the list `key`, which may be absent. `name` is the list's name in messages.
template <class Read>
void each_table(const fs::path& file, TomlTable& in, const char* key, const std::string& name,
                const Read& read) {
  const toml::node* list = in.get(key);
  if (!list) return;
  if (!list->is_array()) in.refuse(key, fmt::format("{} must be a list of tables", key));
  for (const toml::node& node : *list->as_array()) {
    if (!node.is_table()) in.refuse(key, fmt::format("{} must be a list of tables", key));
    TomlTable one(file, *node.as_table(), name);
    read(one);
    one.finish();
  }
}

FigurePanel panel_of(TomlTable& in) {
  FigurePanel panel;
  panel.label = in.required_text("label");
  panel.experiment = in.text("experiment");
  panel.name = in.text("case");
  panel.scene = in.text("scene");
  panel.diagram = in.text("diagram");
  panel.options = in.texts("options");
  const bool of_case = !panel.experiment.empty() && !panel.name.empty();
  if (of_case == !panel.scene.empty())
    in.refuse("label", "a panel needs either experiment and case, or scene");
  return panel;
}

PaperPlan plan_in(const fs::path& file) {
  const toml::table table = read_toml(file);
  TomlTable in(file, table, "");
  PaperPlan plan;
  plan.name = file.stem().string();
  plan.paper = in.required_text("paper");
  plan.title = in.required_text("title");
  plan.authors = in.required_text("authors");
  plan.figures_differ = in.text("figures");
  each_table(file, in, "table", "table", [&](TomlTable& one) {
    plan.tables.push_back(
        {one.required_text("title"), one.required_text("caption"), one.required_text("experiment")});
  });
  each_table(file, in, "figure", "figure", [&](TomlTable& one) {
    PaperFigure figure{
        one.required_text("title"), one.required_text("caption"), one.required_text("differs"), {}};
    each_table(file, one, "panels", figure.title,
               [&](TomlTable& panel) { figure.panels.push_back(panel_of(panel)); });
    if (figure.panels.empty()) one.refuse("title", "a figure needs panels");
    plan.figures.push_back(std::move(figure));
  });
  each_table(file, in, "missing", "missing", [&](TomlTable& one) {
    plan.missing.push_back({one.required_text("what"), one.required_text("why")});
  });
  in.finish();
  return plan;
}

}  // namespace

std::vector<PaperPlan> paper_plans() {
  const std::vector<fs::path> files = experiment_files();
  if (files.empty()) return {};
  const fs::path folder = files.front().parent_path() / "papers";
  std::vector<PaperPlan> plans;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".toml") plans.push_back(plan_in(entry.path()));
  std::ranges::sort(plans, {}, &PaperPlan::name);
  return plans;
}

PaperPlan paper_plan(const std::string& name) {
  std::vector<std::string> known;
  for (PaperPlan& plan : paper_plans()) {
    if (plan.name == name || plan.paper == name) return std::move(plan);
    known.push_back(plan.name);
  }
  throw InputError(fmt::format("{}: no such paper; known: {}", name, fmt::join(known, ", ")));
}

std::vector<std::string> experiments_of(const PaperPlan& plan, const std::vector<std::string>& more) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::ranges::count(names, name) == 0) names.push_back(name);
  };
  for (const PaperFigure& figure : plan.figures)
    for (const FigurePanel& panel : figure.panels)
      if (panel.diagram.empty()) add(panel.experiment);
  for (const PaperTable& table : plan.tables) add(table.experiment);
  std::vector<std::string> installed;
  for (const fs::path& file : experiment_files()) installed.push_back(file.stem().string());
  for (const std::string& name : more)
    if (std::ranges::count(installed, name) > 0) add(name);
  return names;
}

}  // namespace pelage
