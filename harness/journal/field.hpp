// Fields of a row's provenance.
#pragma once
#include <optional>
#include <string>

#include "harness/journal/row.hpp"

namespace pelage {

/// Returns the text that the row's provenance stores under `key`, or "" if there is none.
inline std::string text(const Row& row, const char* key) {
  const auto found = row.provenance.find(key);
  return found != row.provenance.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Returns the number that the row's provenance stores under `key`, or no value if there is none.
inline std::optional<double> number(const Row& row, const char* key) {
  const auto found = row.provenance.find(key);
  if (found == row.provenance.end() || !found->is_number()) return {};
  return found->get<double>();
}

}  // namespace pelage
