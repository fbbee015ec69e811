#include "harness/record/equal_pictures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace pelage {
namespace {

constexpr std::size_t most_sets = 5, most_names = 5;

/// Returns the names in parentheses, because they may contain commas: "(a), (b) and (c)", or "... and 3
/// others".
std::string list_text(const std::vector<std::string>& names) {
  std::string text;
  const std::size_t shown = std::min(names.size(), most_names);
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i + 1 == names.size();
    text += fmt::format("{}({})", i == 0 ? "" : last ? " and " : ", ", names[i]);
  }
  if (names.size() > shown) text += fmt::format(" and {} others", names.size() - shown);
  return text;
}

}  // namespace

std::string equal_pictures(const std::vector<CasePicture>& pictures) {
  std::vector<std::pair<const CasePicture*, std::vector<std::string>>> sets;
  for (const CasePicture& one : pictures) {
    if (one.hash.empty()) continue;
    const auto same = std::find_if(sets.begin(), sets.end(), [&](const auto& set) {
      return set.first->hash == one.hash && set.first->group == one.group;
    });
    if (same == sets.end())
      sets.push_back({&one, {one.name}});
    else if (std::find(same->second.begin(), same->second.end(), one.name) == same->second.end())
      same->second.push_back(one.name);
  }
  std::erase_if(sets, [](const auto& set) { return set.second.size() < 2; });
  if (sets.empty()) return {};
  // A run measures its cases in random order, so the names are sorted.
  for (auto& [first, names] : sets) std::sort(names.begin(), names.end());
  std::sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<std::string> texts;
  for (const auto& [first, names] : sets) {
    if (texts.size() < most_sets) texts.push_back(list_text(names));
  }
  const std::size_t others = sets.size() - texts.size();
  return fmt::format("Equal pictures: {}{}. The settings in which these cases differ change no pixel.",
                     fmt::join(texts, "; "), others > 0 ? fmt::format("; {} other sets", others) : "");
}

}  // namespace pelage
