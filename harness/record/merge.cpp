#include "harness/record/merge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "harness/error.hpp"
#include "harness/record/journal.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// The journal to which a row is written, relative to the folder that the merge creates.
fs::path journal_of(const FoundRow& found) {
  return fs::path(found.row.experiment) / (journal_name(found.journal).stem + ".jsonl");
}

std::string key_of(const FoundRow& found) {
  return journal_of(found).string() + "|" + row_key(found.row);
}

void refuse_odd_names(const FoundRow& found) {
  const auto is_name = [](const std::string& name) {
    return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
           name.find('\0') == std::string::npos;
  };
  for (const std::string& name : {found.row.experiment, found.row.case_name})
    if (!is_name(name))
      throw InputError(
          fmt::format("{}: the name '{}' of an experiment or a case cannot be the name of a file",
                      found.journal.string(), name));
}

/// Returns the properties that must be equal in all rows of a run, even of different cases. Rows with the
/// status error may lack some of them.
std::map<std::string, std::string> common_of(const Row& row) {
  std::map<std::string, std::string> common;
  for (const auto& [part, hash] : row.identity)
    if (part == "device" || part == "sampling" || part == build_part || part == shader_part ||
        part == renderer_part || part.starts_with(kernel_part))
      common[part] = hash;
  for (const char* key : {"preset", "cpu", "driver", "device_version"})
    if (const std::string value = provenance_text(row, key); !value.empty()) common[key] = value;
  common["schema"] = row.schema == 1 ? "1 (without identity)" : "2 or later";
  return common;
}

/// A conflict of two rows (see plan_merge()).
struct Conflict {
  std::set<std::string> differs;  ///< names of the properties in which the two rows differ
  std::string message;
};

/// A set of rows that are written into one folder. No two rows of the set conflict (see plan_merge()).
class Target {
 public:
  std::optional<Conflict> conflict(const FoundRow& found) const {
    if (const auto same = rows_.find(key_of(found)); same != rows_.end())
      return between(*same->second, found);
    if (found.row.status == Status::error) return {};
    for (const auto& [name, value] : common_of(found.row)) {
      const auto first = common_.find({journal_of(found).string(), name});
      if (first == common_.end() || first->second.first == value) continue;
      const FoundRow& other = *first->second.second;
      return Conflict{{name},
                      fmt::format("{} (case {}) and {} (case {}) are not of one run: {} was {}, is {}",
                                  other.journal.string(), other.row.case_name, found.journal.string(),
                                  found.row.case_name, name, first->second.first, value)};
    }
    return {};
  }

  void add(const FoundRow& found) {
    rows_[key_of(found)] = &found;
    if (found.row.status == Status::error) return;
    for (const auto& [name, value] : common_of(found.row))
      common_.try_emplace({journal_of(found).string(), name}, value, &found);
  }

 private:
  static Conflict between(const FoundRow& a, const FoundRow& b) {
    const std::string both = fmt::format("{} and {}: both contain a row of case {}", a.journal.string(),
                                         b.journal.string(), a.row.case_name);
    if (a.row.identity.empty() != b.row.identity.empty())
      return {{"schema"}, both + ", but only one of the rows records the hashes of its inputs (schema 2)"};
    if (const std::vector<std::string> parts = differing_parts(a.row.identity, b.row.identity);
        !parts.empty())
      return {{parts.begin(), parts.end()},
              fmt::format("{}, but the rows measured different inputs: {}", both,
                          fmt::join(differences(a.row.identity, b.row.identity), "; "))};
    return {{"run"},
            fmt::format("{}, measured in different runs ({} and {})", both, a.row.run_id, b.row.run_id)};
  }

  std::map<std::string, const FoundRow*> rows_;  // key -> row
  // Key: a journal, and the name of a property from common_of(). Value: the value of this property in the
  // rows of the journal, and the first row that has it.
  std::map<std::pair<std::string, std::string>, std::pair<std::string, const FoundRow*>> common_;
};

std::vector<FoundRow> without_replaced(const std::vector<FoundRow>& rows) {
  const auto rank = [](const FoundRow* found) {
    return std::pair(found->row.status != Status::error, provenance_text(found->row, "utc"));
  };
  std::map<std::string, const FoundRow*> latest;  // key -> the row to keep
  for (const FoundRow& found : rows) {
    const FoundRow*& best = latest.try_emplace(key_of(found), &found).first->second;
    best = std::ranges::max(best, &found, {}, rank);
  }
  std::vector<FoundRow> kept;
  for (const FoundRow& found : rows)
    if (found.row.status != Status::error || latest.at(key_of(found)) == &found) kept.push_back(found);
  return kept;
}

}  // namespace

Merge plan_merge(const std::vector<FoundRow>& rows, bool keep_apart) {
  Merge merge;
  for (const FoundRow& found : rows) {
    refuse_odd_names(found);
    merge.copies += found.copies.size();
  }
  const std::vector<FoundRow> kept = without_replaced(rows);
  merge.replaced = rows.size() - kept.size();
  std::vector<Target> targets;
  std::vector<std::set<std::string>> differs;
  for (const std::vector<const FoundRow*>& group : groups_of<Target>(kept)) {
    std::size_t place = 0;
    std::set<std::string> names;
    for (; place < targets.size(); ++place) {
      bool fits = true;
      for (const FoundRow* found : group) {
        const std::optional<Conflict> conflict = targets[place].conflict(*found);
        if (!conflict) continue;
        if (!keep_apart)
          throw InputError(
              conflict->message +
              ". Merge only results that belong together, or give --keep-apart, which writes the conflicting rows into a separate folder");
        names.insert(conflict->differs.begin(), conflict->differs.end());
        fits = false;
      }
      if (fits) break;
    }
    if (place == targets.size()) {
      targets.emplace_back();
      differs.emplace_back();
    }
    differs[place].insert(names.begin(), names.end());
    const fs::path folder = place == 0 ? fs::path() : fs::path(fmt::format("apart-{}", place + 1));
    for (const FoundRow* found : group) {
      targets[place].add(*found);
      merge.rows.push_back({*found, folder / journal_of(*found)});
    }
  }
  for (std::size_t i = 1; i < differs.size(); ++i)
    merge.apart.push_back(fmt::format("{}", fmt::join(differs[i], ", ")));
  return merge;
}

// Writes the merged journals and pictures into the folder that `pelage merge` creates.

namespace {

bool equal_bytes(const fs::path& a, const fs::path& b) {
  std::ifstream one(a, std::ios::binary), other(b, std::ios::binary);
  return std::equal(std::istreambuf_iterator<char>(one), {}, std::istreambuf_iterator<char>(other), {});
}

/// Copies a picture. If `to` exists and has other content, the copy is named STEM@2.png, STEM@3.png, ...,
/// where STEM is the name of `to` without ".png".
void copy_picture(const fs::path& from, const fs::path& to) {
  fs::create_directories(to.parent_path());
  fs::path place = to;
  for (int i = 2; fs::exists(place); ++i) {
    if (equal_bytes(from, place)) return;
    place = to.parent_path() / fmt::format("{}@{}.png", to.stem().string(), i);
  }
  fs::copy_file(from, place);
}

void write_journals(const Merge& merge, const fs::path& folder) {
  std::map<fs::path, std::vector<const Row*>> journals;
  for (const MergedRow& row : merge.rows) journals[row.journal].push_back(&row.found.row);
  // The journals are not flushed after every row. The input folders still contain all rows, so it suffices to
  // flush each file once at the end of the merge.
  JournalCalls calls = system_calls();
  calls.fdatasync = [](int) { return 0; };
  for (const auto& [file, rows] : journals) {
    Journal journal(folder / file, Journal::Mode::fresh, calls);
    for (const Row* row : rows) journal.append(*row);
  }
}

std::size_t copy_pictures(const Merge& merge, const fs::path& folder) {
  std::map<fs::path, std::set<fs::path>> journals;  // folder of an experiment -> journals in this folder
  for (const MergedRow& row : merge.rows) journals[row.journal.parent_path()].insert(row.journal);
  std::size_t pictures = 0;
  for (const MergedRow& row : merge.rows) {
    // A row with the status error has no valid picture, even if a file with the name of its picture exists.
    if (row.found.row.status == Status::error) continue;
    const fs::path from = picture_of(row.found);
    if (!fs::is_regular_file(from)) continue;
    const fs::path place = row.journal.parent_path();
    const std::string suffix = journals.at(place).size() > 1 ? "@" + row.journal.stem().string() : "";
    copy_picture(from, folder / place / "images" / (row.found.row.case_name + suffix + ".png"));
    ++pictures;
  }
  return pictures;
}

}  // namespace

void require_new_folder(const fs::path& folder) {
  if (fs::is_directory(folder) && fs::is_empty(folder)) return;
  if (fs::exists(folder))
    throw InputError(fmt::format(
        "{}: exists; merge writes only into a new folder. To add results to merged results, give the merged folder as an input and another name for the new folder",
        folder.string()));
}

std::size_t write_merge(const Merge& merge, const fs::path& folder) {
  require_new_folder(folder);
  fs::path target = fs::absolute(folder).lexically_normal();
  if (!target.has_filename()) target = target.parent_path();
  const fs::path parent = target.parent_path();
  const fs::path temporary = parent / fmt::format(".{}.{}", target.filename().string(), getpid());
  try {
    fs::create_directories(temporary);
    write_journals(merge, temporary);
    const std::size_t pictures = copy_pictures(merge, temporary);
    for (const auto& entry : fs::recursive_directory_iterator(temporary)) sync(entry.path());
    fs::rename(temporary, target);
    sync(parent);
    return pictures;
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove_all(temporary, ignored);
    throw InputError(fmt::format("{}: cannot be written: {}", folder.string(), error.code().message()));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(temporary, ignored);
    throw;
  }
}

}  // namespace pelage
