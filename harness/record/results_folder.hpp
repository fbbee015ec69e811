// Reads the rows in folders of results, and prevents runs from changing recorded results.
#pragma once
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/record/row.hpp"

namespace pelage {

/// A row and the journal that contains it.
struct FoundRow {
  Row row;
  std::filesystem::path journal;
  std::vector<std::filesystem::path> copies = {};  ///< other journals that contain the same row
};

/// Divides the rows into groups that stay together: the rows of a journal, in the order of their first rows,
/// or several groups of a journal if its rows conflict with each other. A Set of rows has the functions
/// conflict(row), which returns whether the row conflicts with one of the set, and add(row).
template <class Set>
std::vector<std::vector<const FoundRow*>> groups_of(const std::vector<FoundRow>& rows) {
  std::vector<std::filesystem::path> journals;
  std::map<std::filesystem::path, std::vector<std::pair<Set, std::vector<const FoundRow*>>>> parts;
  for (const FoundRow& found : rows) {
    if (!parts.contains(found.journal)) journals.push_back(found.journal);
    auto& own = parts[found.journal];
    auto place = std::ranges::find_if(own, [&](const auto& part) { return !part.first.conflict(found); });
    if (place == own.end()) place = own.emplace(own.end());
    place->first.add(found);
    place->second.push_back(&found);
  }
  std::vector<std::vector<const FoundRow*>> groups;
  for (const std::filesystem::path& journal : journals)
    for (const auto& [unused, group] : parts.at(journal)) groups.push_back(group);
  return groups;
}

/// Returns all journals that `places` name: journals (*.jsonl), or folders with journals at any depth, sorted
/// by path. Throws InputError for a missing path, or a folder without a journal.
std::vector<std::filesystem::path> journals_of(const std::vector<std::string>& places);

/// Returns all rows of journals_of(). If several journals contain a row, it is returned once: `journal` is
/// the first of these journals, and `copies` are the others. Throws InputError like journals_of(), for a
/// damaged journal, if two rows have the same run, experiment, case, variant, device, repeat and overrides
/// but are not equal, or if two rows of different measurements have equal frame times: one of them must be a
/// changed copy, because measured times are never all equal.
std::vector<FoundRow> read_results(const std::vector<std::string>& places);

/// A part of a journal that contributes no row to the results, and the reason.
struct LeftOut {
  std::string experiment, case_name;  ///< "" if the part is a line without a readable row, or a whole journal
  std::string where;                  ///< path of the journal; "" if the reason concerns several journals
  std::string reason;
};

struct Results {
  std::vector<FoundRow> rows;
  std::vector<LeftOut> left_out;
};

/// Returns the rows that read_results() returns, and everything else in the journals: copies of rows, rows
/// with the status error that later rows replace, incomplete last lines, and journals without a row. Throws
/// like read_results().
Results read_all_results(const std::vector<std::string>& places);

/// The name of a journal file: STEM.jsonl, or STEM.i-of-n.jsonl for shard i of n. pelage run uses DEVICE@HOST
/// as STEM.
struct JournalName {
  std::string stem;
  int index = 0, count = 1;  ///< i and n of the shard; 0 and 1 if the name has no ".i-of-n"
};
JournalName journal_name(const std::filesystem::path& journal);

/// Returns the path of the row's picture in the folder images/ next to the journal: CASE@DEVICE@HOST.png or
/// CASE@DEVICE.png if there is such a file, otherwise CASE.png, which may not exist.
std::filesystem::path picture_of(const FoundRow& found);

/// Throws InputError if `folder` is in the repository's results/, whose recorded results a new run must not
/// change.
void refuse_recordings(const std::filesystem::path& folder);

}  // namespace pelage
