#include "harness/results/tuning.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <regex>

#include "harness/error.hpp"

namespace pelage {
namespace {

void collect(const std::filesystem::path& file, const toml::table& table, bool nested,
             std::map<std::string, int>& into) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const auto where = fmt::format("{}:{}: {}", file.string(), node.source().begin.line, name);
    if (const auto* inner = node.as_table(); inner && !nested) {
      collect(file, *inner, true, into);
      continue;
    }
    const auto value = node.value_exact<std::int64_t>();
    if (!value || *value < 0 || *value > 1 << 20)
      throw InputError(where + ": a tuning axis is a whole number from 0 to 1048576");
    if (!std::regex_match(name, std::regex("[A-Z][A-Z0-9_]*")))
      throw InputError(where + ": a tuning axis is named in capitals, such as TILE_W");
    if (!into.emplace(name, int(*value)).second) throw InputError(where + ": stands twice");
  }
}

}  // namespace

std::map<std::string, int> read_tuning(const std::filesystem::path& file) {
  try {
    std::map<std::string, int> result;
    collect(file, toml::parse_file(file.string()), false, result);
    return result;
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: not TOML: {}", file.string(), error.source().begin.line, error.description()));
  }
}

}  // namespace pelage
