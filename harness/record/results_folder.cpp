#include "harness/record/results_folder.hpp"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <map>
#include <set>

#include "harness/error.hpp"
#include "harness/record/journal.hpp"

namespace pelage {

namespace fs = std::filesystem;

namespace {

/// Two rows with the same text that are not equal: somebody has changed one of them.
std::string measurement_of(const Row& row) {
  return fmt::format("{}|{}|{}", row.run_id, row.device, row_key(row));
}

/// Finds exact and changed copies among the rows read so far: rows with the same measurement_of() or frame
/// times.
class Known {
 public:
  /// Returns the earlier row of which `row` is an exact copy, or null if there is none. Throws InputError if
  /// `row` is a changed copy of an earlier row.
  const FoundRow* copied(const Row& row, const fs::path& journal, const std::vector<FoundRow>& rows) const {
    if (const auto same = measurements_.find(measurement_of(row)); same != measurements_.end()) {
      const FoundRow& first = rows[same->second];
      if (to_line(first.row) == to_line(row)) return &first;
      throw InputError(fmt::format(
          "{} and {}: each contains a row of case {} from the same run, but the two rows differ. One of the files was changed; give only the original",
          first.journal.string(), journal.string(), row.case_name));
    }
    if (const auto same = times_.find(frame_ms(row)); same != times_.end()) {
      const FoundRow& first = rows[same->second];
      throw InputError(fmt::format(
          "{} and {}: the rows of the cases {} and {} claim to be different measurements, but their {} frame times are equal. One of these rows is a changed copy; give only the original",
          first.journal.string(), journal.string(), first.row.case_name, row.case_name,
          frame_ms(row).size()));
    }
    return nullptr;
  }

  void add(const Row& row, std::size_t index) {
    measurements_[measurement_of(row)] = index;
    if (frame_ms(row).size() >= fewest_times) times_.try_emplace(frame_ms(row), index);
  }

 private:
  /// Least number of frame times to compare. A single time may be equal by chance, because clocks have a
  /// limited resolution.
  static constexpr std::size_t fewest_times = 2;

  std::map<std::string, std::size_t> measurements_;   // measurement_of() -> index of the row
  std::map<std::vector<double>, std::size_t> times_;  // frame times -> index of the row
};

void list_rest(const fs::path& journal, const JournalContents& contents, std::vector<LeftOut>& into) {
  for (const Row& row : contents.replaced)
    into.push_back({row.experiment, row.case_name, journal.string(),
                    fmt::format("error: {}; a later row replaces this one", row.reason)});
  if (contents.torn > 0)
    into.push_back(
        {"", "", journal.string(), fmt::format("the last line ({} bytes) is not complete", contents.torn)});
  if (contents.rows.empty()) into.push_back({"", "", journal.string(), "the journal has no complete row"});
}

}  // namespace

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

Results read_all_results(const std::vector<std::string>& places) {
  Results results;
  Known known;
  std::set<fs::path> seen;
  for (const fs::path& journal : journals_of(places)) {
    JournalContents contents = read_contents(journal);
    if (seen.insert(journal).second) list_rest(journal, contents, results.left_out);
    for (Row& row : contents.rows) {
      const FoundRow* first = known.copied(row, journal, results.rows);
      if (!first) {
        known.add(row, results.rows.size());
        results.rows.push_back({std::move(row), journal});
        continue;
      }
      results.left_out.push_back({row.experiment, row.case_name, journal.string(),
                                  fmt::format("copy of a row of {}", first->journal.string())});
      results.rows[std::size_t(first - results.rows.data())].copies.push_back(journal);
    }
  }
  return results;
}

std::vector<FoundRow> read_results(const std::vector<std::string>& places) {
  return read_all_results(places).rows;
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
  const auto [end, unused] = std::ranges::mismatch(recordings, wanted);
  if (end == recordings.end())
    throw InputError(fmt::format(
        "{}: this folder contains recorded results, which a run must not change; give another folder with -o",
        folder.string()));
}

}  // namespace pelage
