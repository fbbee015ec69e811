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

/// The identities of cases.
class Identities {
 public:
  void add(const FoundRow& found) { identities_[names_of(found.row)] = found.row.identity; }
  const Identity* of(const FoundRow& found) const {
    const auto place = identities_.find(names_of(found.row));
    return place == identities_.end() ? nullptr : &place->second;
  }
  bool conflict(const FoundRow& found) const { return of(found) && *of(found) != found.row.identity; }

 private:
  std::map<std::string, Identity> identities_;  // result of names_of() -> identity
};

}  // namespace

std::vector<InputSet> input_sets(const std::vector<FoundRow>& rows) {
  std::vector<InputSet> sets(1);
  std::vector<Identities> identities(1);
  std::vector<std::set<std::string>> differing(1);
  for (const std::vector<const FoundRow*>& group : groups_of<Identities>(rows)) {
    const auto place = std::find_if(identities.begin(), identities.end(), [&](const Identities& set) {
      return std::none_of(group.begin(), group.end(), [&](auto* found) { return set.conflict(*found); });
    });
    const auto i = std::size_t(place - identities.begin());
    if (i == sets.size()) {
      sets.emplace_back();
      identities.emplace_back();
      differing.emplace_back();
    }
    for (const FoundRow* found : group) {
      sets[i].rows.push_back(*found);
      identities[i].add(*found);
      const Identity* first = identities.front().of(*found);
      if (i == 0 || !first) continue;
      if (found->row.identity.empty() || first->empty())
        differing[i].insert("identity incomplete");
      else
        for (const std::string& name : differing_parts(*first, found->row.identity))
          differing[i].insert(name);
    }
  }
  for (std::size_t i = 1; i < sets.size(); ++i)
    sets[i].differs = fmt::format("{}", fmt::join(differing[i], ", "));
  return sets;
}

}  // namespace pelage
