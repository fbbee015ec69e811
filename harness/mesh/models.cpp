#include "harness/mesh/models.hpp"

#include <array>

#include "harness/base/toml_table.hpp"
#include "harness/data_folder.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

using Counts = std::array<std::uint32_t, 2>;

std::map<std::string, Counts> published_counts(const std::filesystem::path& file, const toml::table& table) {
  std::map<std::string, Counts> found;
  for (const auto& [name, value] : table) {
    const toml::array* pair = value.as_array();
    for (unsigned i = 0; i < 2; ++i) {
      const auto count = pair && pair->size() == 2 ? (*pair)[i].value_exact<std::int64_t>() : std::nullopt;
      if (!count || *count < 0 || *count > 100'000'000)
        refuse(
            file, &value,
            "published must be a table with entries TOPOLOGY = [number of masses, number of springs] or mesh = [number of vertices, number of faces]");
      found[std::string(name.str())][i] = std::uint32_t(*count);
    }
  }
  return found;
}

Model read_model(const std::filesystem::path& file, const toml::table& table) {
  TomlTable in(file, table, "");
  Model model;
  model.name = in.required_text("name");
  model.source = in.required_text("source");
  if (const auto faces = in.whole("faces", 1, 100'000'000)) model.faces = std::uint32_t(*faces);
  const std::vector<double> rotation = in.numbers("rotation");
  if (in.has("rotation") && rotation.size() != 3) in.refuse("rotation", "rotation must be three numbers");
  for (std::size_t i = 0; i < rotation.size(); ++i) model.rotation[int(i)] = rotation[i];
  model.wrap = in.flag("wrap");
  model.stand_in = in.flag("stand_in");
  model.licence = in.required_text("licence");
  model.footnote = in.required_text("footnote");
  if (const toml::table* counts = in.table("published")) model.published = published_counts(file, *counts);
  in.finish();
  return model;
}

}  // namespace

std::vector<Model> read_models(const std::filesystem::path& file) {
  const toml::table table = read_toml(file);
  std::vector<Model> list;
  const toml::array* entries = table["model"].as_array();
  if (!entries) refuse(file, nullptr, "the file has no [[model]]");
  for (const toml::node& entry : *entries) {
    const toml::table* model = entry.as_table();
    if (!model) refuse(file, &entry, "model must be a table");
    list.push_back(read_model(file, *model));
  }
  return list;
}

std::vector<Model> models() {
  for (const auto& folder : data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR))
    if (const auto file = folder / "experiments" / "models.toml"; std::filesystem::exists(file))
      return read_models(file);
  throw InputError(
      "experiments/models.toml was not found: set PELAGE_DATA to the folder that holds experiments/");
}

std::string footnote_of(const std::string& name) {
  static const std::vector<Model> known = models();
  const auto found = std::ranges::find(known, name, &Model::name);
  return found == known.end() ? std::string{} : found->footnote;
}

}  // namespace pelage
