// Merges the rows of several folders of results, such as the shards of a run, into one new folder.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// A row, and the journal to which it is written. The path of the journal is relative to the new folder:
/// "EXPERIMENT/DEVICE@HOST.jsonl". A row that conflicts with a row in such a journal (see plan_merge()) goes
/// to "apart-2/EXPERIMENT/DEVICE@HOST.jsonl". If it conflicts there too, it goes to "apart-3/...", and so on.
struct MergedRow {
  FoundRow found;
  std::filesystem::path journal;
};

struct Merge {
  std::vector<MergedRow> rows;     ///< in the order of the inputs
  std::size_t copies = 0;          ///< number of rows that are copies of other rows; left out
  std::size_t replaced = 0;        ///< number of rows with errors that other rows replace; left out
  std::vector<std::string> apart;  ///< one text per folder apart-N: names of the properties that differ
};

/// Decides to which journal each row of read_results() is written. Rows go to the same journal if they have
/// the same experiment and their journals have the same name, apart from the shard (".i-of-n"). A journal
/// contains at most one row for each case and each process of --repeat. A row with the status error is left
/// out if the same case has a row without an error or a later row with an error.
///
/// Two rows conflict if they would have the same key in the same journal but are different measurements:
/// their identities differ, or they come from different runs. Rows of different cases in one journal also
/// conflict if they differ in a property that is equal for all cases of a run. These properties are the
/// device, its driver, the kernels, the build, the sampling limits, the preset, the CPU and the schema. If
/// `keep_apart` is false, a conflict throws InputError, whose message names both journals and what differs.
/// If `keep_apart` is true, the conflicting rows go to a folder apart-N.
///
/// Also throws InputError if the name of a row's experiment or case cannot be the name of a file.
Merge plan_merge(const std::vector<FoundRow>& rows, bool keep_apart);

/// Writes the rows and copies their pictures into `folder`, which must be empty or must not exist. The name
/// of a picture is CASE.png, or CASE@DEVICE@HOST.png if the experiment has rows of several devices or hosts.
/// The function first writes into a temporary folder and then renames this folder, so that an interrupted
/// merge leaves no incomplete results in `folder`. Returns the number of pictures. Throws InputError if the
/// folder or a file cannot be written.
std::size_t write_merge(const Merge& merge, const std::filesystem::path& folder);

/// Throws InputError if `folder` is a file or a folder that is not empty.
void require_new_folder(const std::filesystem::path& folder);

}  // namespace pelage
