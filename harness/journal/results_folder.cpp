#include "harness/journal/results_folder.hpp"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <map>

#include "harness/error.hpp"
#include "harness/journal/journal.hpp"

namespace pelage {
namespace {

/// Returns a text that identifies the measurement of a row: the run, the device and the row's key. Two rows
/// with the same text should be copies of one row.
std::string measurement_of(const Row& row) {
  return fmt::format("{}|{}|{}", row.run_id, row.device, row_key(row));
}

}  // namespace

namespace fs = std::filesystem;

std::vector<fs::path> journals_of(const std::vector<std::string>& places) {
  std::vector<fs::path> all;
  for (const std::string& place : places) {
    std::vector<fs::path> journals;
    if (fs::is_directory(place)) {
      for (const auto& entry : fs::recursive_directory_iterator(place))
        if (entry.is_regular_file() && entry.path().extension() == ".jsonl") journals.push_back(entry.path());
      if (journals.empty()) throw InputError(fmt::format("{}: contains no results (*.jsonl)", place));
    } else if (fs::is_regular_file(place)) {
      journals.emplace_back(place);
    } else {
      throw InputError(fmt::format("{}: no such folder or file of results", place));
    }
    std::sort(journals.begin(), journals.end());
    all.insert(all.end(), journals.begin(), journals.end());
  }
  return all;
}

std::vector<FoundRow> read_results(const std::vector<std::string>& places) {
  std::vector<FoundRow> rows;
  std::map<std::string, std::size_t> known;  // measurement -> index in `rows`
  for (const fs::path& journal : journals_of(places))
    for (Row& row : read_journal(journal)) {
      const auto [entry, added] = known.try_emplace(measurement_of(row), rows.size());
      if (added) {
        rows.push_back({std::move(row), journal});
        continue;
      }
      FoundRow& first = rows[entry->second];
      if (to_line(first.row) != to_line(row))
        throw InputError(
            fmt::format("{} and {}: each contains a row of case {} from the same run, but the two rows "
                        "differ. One of the "
                        "files was changed; give only the original",
                        first.journal.string(), journal.string(), row.case_name));
      first.copies.push_back(journal);
    }
  return rows;
}

JournalName journal_name(const fs::path& journal) {
  const std::string stem = journal.stem().string();
  static const RE2 sharded("(?s)(.+)\\.([0-9]{1,6})-of-([0-9]{1,6})");
  JournalName name;
  if (RE2::FullMatch(stem, sharded, &name.stem, &name.index, &name.count) && name.index < name.count)
    return name;
  return {stem};
}

fs::path picture_of(const FoundRow& found) {
  const fs::path folder = found.journal.parent_path() / "images";
  const std::string stem = journal_name(found.journal).stem;
  for (const std::string& suffix : {stem, stem.substr(0, stem.find('@'))}) {
    const fs::path own = folder / fmt::format("{}@{}.png", found.row.case_name, suffix);
    if (fs::exists(own)) return own;
  }
  return folder / (found.row.case_name + ".png");
}

void refuse_recordings(const fs::path& folder) {
  const fs::path recordings = fs::weakly_canonical(fs::path(PELAGE_SOURCE_DIR) / "results");
  const fs::path wanted = fs::weakly_canonical(folder);
  const auto [end, unused] =
      std::mismatch(recordings.begin(), recordings.end(), wanted.begin(), wanted.end());
  if (end == recordings.end())
    throw InputError(fmt::format(
        "{}: this folder contains recorded results, which a run must not change; give another folder with -o",
        folder.string()));
}

}  // namespace pelage
