// Finds the name that a user probably meant by a misspelt one.
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

/// Returns the Levenshtein distance between two words.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

/// Returns the name with the smallest edit distance from `wanted`. Returns "" if this distance is larger than
/// 2 and larger than a third of the length of `wanted`, or if `wanted` has 100 characters or more.
inline std::string nearest_name(std::string_view wanted, const std::vector<std::string>& names) {
  std::string best;
  if (wanted.size() >= 100) return best;
  std::size_t least = std::max<std::size_t>(2, std::min<std::size_t>(wanted.size(), 40) / 3) + 1;
  for (const std::string& name : names)
    if (const std::size_t here = edit_distance(wanted, name); here < least) least = here, best = name;
  return best;
}

}  // namespace pelage
