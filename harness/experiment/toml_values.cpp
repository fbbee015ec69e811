#include "harness/experiment/toml_values.hpp"

#include <fmt/format.h>

#include "harness/error.hpp"

namespace pelage {

namespace fs = std::filesystem;

void refuse(const fs::path& file, const toml::node* node, const std::string& what) {
  const auto line = node ? node->source().begin.line : 0;
  throw InputError(line ? fmt::format("{}:{}: {}", file.string(), line, what)
                        : fmt::format("{}: {}", file.string(), what));
}

double number_at(const fs::path& file, const toml::table& table, std::string_view key, double otherwise,
                 double least, double most) {
  const toml::node* node = table.get(key);
  if (!node) return otherwise;
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !(*value >= least && *value <= most))
    refuse(file, node, fmt::format("{} must be a number in [{}, {}]", key, least, most));
  return *value;
}

}  // namespace pelage
