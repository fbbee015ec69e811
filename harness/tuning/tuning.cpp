#include "harness/tuning/tuning.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <re2/re2.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "harness/base/toml_file.hpp"
#include "harness/cl/program.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

constexpr int kMost = 1 << 20;

int axis_value(const fs::path& file, const toml::node& node, const std::string& name) {
  const auto value = node.value_exact<std::int64_t>();
  if (!value || *value < 0 || *value > kMost)
    refuse(file, &node, name + ": the value of a tuning axis must be a whole number from 0 to 1048576");
  return int(*value);
}

void check_name(const fs::path& file, const toml::node& node, const std::string& name) {
  if (!RE2::FullMatch(name, "[A-Z][A-Z0-9_]*"))
    refuse(file, &node, name + ": the name of a tuning axis must be in capitals, such as TILE_W");
}

void collect(const fs::path& file, const toml::table& table, bool nested, const std::set<std::string>& known,
             Tuning& into) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (const auto* inner = node.as_table(); inner && !nested) {
      collect(file, *inner, true, known, into);
      continue;
    }
    const int value = axis_value(file, node, name);
    check_name(file, node, name);
    if (!known.contains(name))
      refuse(file, &node,
             fmt::format("{}: no such tuning axis; the tuning axes are {}", name, fmt::join(known, ", ")));
    if (!into.emplace(name, value).second) refuse(file, &node, name + ": the axis occurs twice");
  }
}

TuningAxis axis_of(const fs::path& file, const std::string& name, const toml::node& node) {
  check_name(file, node, name);
  const toml::table* table = node.as_table();
  const toml::array* values = table ? (*table)["values"].as_array() : nullptr;
  if (!values || values->empty())
    refuse(
        file, &node,
        name + ": an axis must be a table with the keys 'what', 'values' (a list) and optionally 'shipped'");
  TuningAxis axis{name, (*table)["what"].value_or(std::string{}), {}, {}};
  for (const toml::node& value : *values) axis.values.push_back(axis_value(file, value, name));
  if (const toml::node* shipped = table->get("shipped")) axis.shipped = axis_value(file, *shipped, name);
  if (axis.shipped) std::erase(axis.values, *axis.shipped);
  return axis;
}

}  // namespace

std::vector<std::string> tunable_stages() {
  std::vector<std::string> stages;
  for (const auto& entry : fs::directory_iterator(cl::kernel_folder()))
    if (fs::is_regular_file(entry.path() / "tuning.toml")) stages.push_back(entry.path().filename().string());
  std::sort(stages.begin(), stages.end());
  return stages;
}

std::vector<TuningAxis> tuning_axes(const std::string& stage) {
  const std::vector<std::string> stages = tunable_stages();
  if (std::find(stages.begin(), stages.end(), stage) == stages.end())
    throw InputError(fmt::format("stage '{}' has no tuning axes; the stages with tuning axes are {}", stage,
                                 fmt::join(stages, ", ")));
  const fs::path file = cl::kernel_folder() / stage / "tuning.toml";
  const toml::table table = read_toml(file);
  // toml++ sorts the keys by name. The search needs the order of the file, so this code sorts the axes by
  // line.
  std::vector<std::pair<toml::source_index, TuningAxis>> axes;
  for (const auto& [key, node] : table)
    axes.emplace_back(node.source().begin.line, axis_of(file, std::string(key.str()), node));
  std::sort(axes.begin(), axes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<TuningAxis> result;
  result.reserve(axes.size());
  for (auto& [line, axis] : axes) result.push_back(std::move(axis));
  return result;
}

Tuning read_tuning(const fs::path& file) {
  std::set<std::string> known;
  for (const std::string& stage : tunable_stages())
    for (const TuningAxis& axis : tuning_axes(stage)) known.insert(axis.name);
  Tuning result;
  collect(file, read_toml(file), false, known, result);
  return result;
}

std::string with_stage(const std::string& before, const std::string& stage, const Tuning& values,
                       const std::string& note) {
  // The file has one block per stage. A block begins at its comment, or at its [stage] line if it has no
  // comment. This loop keeps all blocks except that of `stage`.
  std::string kept, block;
  bool own = false, in_table = false;
  const auto close = [&] {
    if (!own) kept += block;
    block.clear();
    own = in_table = false;
  };
  std::istringstream lines(before);
  for (std::string line; std::getline(lines, line);) {
    const bool header = line.starts_with("["), comment = line.starts_with("#");
    if ((comment && in_table) || (header && in_table)) close();
    if (header) {
      in_table = true;
      own = line == "[" + stage + "]";
    }
    block += line + "\n";
  }
  close();
  if (!kept.empty() && !kept.ends_with("\n\n")) kept += "\n";
  std::istringstream notes(note);
  for (std::string line; std::getline(notes, line);) kept += "# " + line + "\n";
  kept += "[" + stage + "]\n";
  for (const auto& [axis, value] : values) kept += fmt::format("{} = {}\n", axis, value);
  return kept;
}

std::string text_of(const Tuning& tuning) {
  if (tuning.empty()) return "shipped";
  std::string text;
  for (const auto& [axis, value] : tuning)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", axis, value);
  return text;
}

}  // namespace pelage
