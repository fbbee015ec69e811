#include "harness/mesh/models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "harness/base/toml_file.hpp"
#include "harness/data_folder.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

class Reader {
 public:
  Reader(const std::filesystem::path& file, const toml::table& table) : file_(file), table_(table) {}

  template <class T>
  std::optional<T> find(std::string_view key, const char* wanted) const {
    const toml::node* node = table_.get(key);
    if (!node) return {};
    if (const auto value = node->value_exact<T>()) return value;
    fail(*node, key, wanted);
  }

  std::string text(std::string_view key) const {
    if (const auto value = find<std::string>(key, "a string")) return *value;
    fail(table_, key, "given as a string");
  }

  glm::dvec3 vector(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (!node) return glm::dvec3(0);
    const toml::array* list = node->as_array();
    glm::dvec3 value(0);
    if (!list || list->size() != 3) fail(*node, key, "three numbers");
    for (unsigned i = 0; i < 3; ++i) {
      const auto number = (*list)[i].value<double>();
      if (!number) fail(*node, key, "three numbers");
      value[int(i)] = *number;
    }
    return value;
  }

  std::map<std::string, std::array<std::uint32_t, 2>> counts(std::string_view key) const {
    std::map<std::string, std::array<std::uint32_t, 2>> found;
    const toml::node* node = table_.get(key);
    if (!node) return found;
    const char* wanted = "a table with entries TOPOLOGY = [number of masses, number of springs]";
    const toml::table* rows = node->as_table();
    if (!rows) fail(*node, key, wanted);
    for (const auto& [name, value] : *rows) {
      const toml::array* pair = value.as_array();
      if (!pair || pair->size() != 2) fail(value, key, wanted);
      for (unsigned i = 0; i < 2; ++i) {
        const auto count = (*pair)[i].value_exact<std::int64_t>();
        if (!count || *count < 0 || *count > 100'000'000) fail(value, key, wanted);
        found[std::string(name.str())][i] = std::uint32_t(*count);
      }
    }
    return found;
  }

  void only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table_)
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
        fail(node, key.str(), "removed: unknown key");
  }

  [[noreturn]] void fail(const toml::node& node, std::string_view key, std::string_view wanted) const {
    throw InputError(
        fmt::format("{}:{}: {} must be {}", file_.string(), node.source().begin.line, key, wanted));
  }

 private:
  const std::filesystem::path& file_;
  const toml::table& table_;
};

Model read_model(const Reader& in, const toml::table& table) {
  in.only({"name", "source", "faces", "rotation", "wrap", "stand_in", "licence", "footnote", "published"});
  Model model;
  model.name = in.text("name");
  model.source = in.text("source");
  if (const auto faces = in.find<std::int64_t>("faces", "a whole number")) {
    if (*faces < 1 || *faces > 100'000'000) in.fail(*table.get("faces"), "faces", "1 to 100000000");
    model.faces = std::uint32_t(*faces);
  }
  model.rotation = in.vector("rotation");
  model.wrap = in.find<bool>("wrap", "true or false").value_or(false);
  model.stand_in = in.find<bool>("stand_in", "true or false").value_or(false);
  model.licence = in.text("licence");
  model.footnote = in.text("footnote");
  model.published = in.counts("published");
  return model;
}

}  // namespace

std::vector<Model> read_models(const std::filesystem::path& file) {
  const toml::table table = read_toml(file);
  std::vector<Model> list;
  const toml::array* entries = table["model"].as_array();
  if (!entries) throw InputError(fmt::format("{}: the file has no [[model]]", file.string()));
  for (const toml::node& entry : *entries) {
    const toml::table* model = entry.as_table();
    if (!model)
      throw InputError(fmt::format("{}:{}: model must be a table", file.string(), entry.source().begin.line));
    list.push_back(read_model(Reader(file, *model), *model));
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

}  // namespace pelage
