// Writes the merged journals and pictures into the folder that `pelage merge` creates.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "harness/error.hpp"
#include "harness/record/journal.hpp"
#include "harness/record/merge.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

bool equal_bytes(const fs::path& a, const fs::path& b) {
  if (fs::file_size(a) != fs::file_size(b)) return false;
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
