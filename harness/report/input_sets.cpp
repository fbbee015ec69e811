#include "harness/report/input_sets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace pelage {
namespace {

std::string names_of(const Row& row) {
  std::string text = fmt::format("{}|{}|{}|{}|{}", row.experiment, row.case_name, row.variant, row.device,
                                 row.provenance.value("host", std::string()));
  for (const auto& [key, value] : row.overrides) text += fmt::format("|{}={}", key, value);
  return text;
}

/// Name of a case (names_of()) -> its identity.
using Identities = std::map<std::string, Identity>;

bool conflicts(const Identities& set, const std::vector<FoundRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [&](const FoundRow& found) {
    const auto place = set.find(names_of(found.row));
    return place != set.end() && place->second != found.row.identity;
  });
}

/// Divides the rows of a journal into lists in which each case has only one identity: usually one list.
std::vector<std::vector<FoundRow>> parts_of(const std::vector<FoundRow>& journal) {
  std::vector<std::vector<FoundRow>> parts;
  std::vector<Identities> identities;
  for (const FoundRow& found : journal) {
    std::size_t i = 0;
    while (i < parts.size() && conflicts(identities[i], {found})) ++i;
    if (i == parts.size()) {
      parts.emplace_back();
      identities.emplace_back();
    }
    parts[i].push_back(found);
    identities[i][names_of(found.row)] = found.row.identity;
  }
  return parts;
}

/// Returns one list of rows per journal, in the order of their first rows.
std::vector<std::vector<FoundRow>> journals_of(const std::vector<FoundRow>& rows) {
  std::vector<std::vector<FoundRow>> journals;
  std::map<std::filesystem::path, std::size_t> index;
  for (const FoundRow& found : rows) {
    const auto [place, added] = index.try_emplace(found.journal, journals.size());
    if (added) journals.emplace_back();
    journals[place->second].push_back(found);
  }
  return journals;
}

}  // namespace

std::vector<InputSet> input_sets(const std::vector<FoundRow>& rows) {
  std::vector<InputSet> sets(1);
  std::vector<Identities> identities(1);
  std::vector<std::set<std::string>> differing(1);
  for (const std::vector<FoundRow>& journal : journals_of(rows))
    for (const std::vector<FoundRow>& part : parts_of(journal)) {
      std::size_t i = 0;
      while (i < sets.size() && conflicts(identities[i], part)) ++i;
      if (i == sets.size()) {
        sets.emplace_back();
        identities.emplace_back();
        differing.emplace_back();
      }
      for (const FoundRow& found : part) {
        const std::string names = names_of(found.row);
        sets[i].rows.push_back(found);
        identities[i][names] = found.row.identity;
        const auto first = identities.front().find(names);
        if (i == 0 || first == identities.front().end()) continue;
        if (found.row.identity.empty() || first->second.empty())
          differing[i].insert("identity incomplete");
        else
          for (const std::string& name : differing_parts(first->second, found.row.identity))
            differing[i].insert(name);
      }
    }
  for (std::size_t i = 1; i < sets.size(); ++i)
    sets[i].differs = fmt::format("{}", fmt::join(differing[i], ", "));
  return sets;
}

}  // namespace pelage
