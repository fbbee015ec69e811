// Joins the rows of several folders of results, such as the shards of a run, into one folder.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// A row and the journal that it is written to, relative to the new folder: "EXPERIMENT/DEVICE@HOST.jsonl".
/// Rows that conflict with these (see plan_merge()) go to "apart-2/EXPERIMENT/DEVICE@HOST.jsonl", rows that
/// conflict with both folders go to "apart-3/...", and so on.
struct MergedRow {
  FoundRow found;
  std::filesystem::path journal;
};

struct Merge {
  std::vector<MergedRow> rows;  ///< in the order of the inputs
  std::size_t copies = 0;       ///< rows that were left out because they are copies of others
  std::size_t replaced = 0;     ///< rows with the status error that were left out because a better row exists
  std::vector<std::string> apart;  ///< one text per folder apart-N: what differs
};

/// Decides where the rows of read_results() go. Rows go to the same journal if their experiments are equal
/// and the names of their journals are equal without the shard (".i-of-n"). In a journal, a case has at most
/// one row per process of --repeat. A row with the status error is left out if there is a row without an
/// error for the same case, or a later row with an error.
///
/// Two rows conflict if they have the same key in the same journal but are different measurements: their
/// identities differ, or they come from different runs. Two rows of one journal also conflict, whatever their
/// cases, if the device, its driver, the kernels, the limits of sampling, the preset, the CPU or the schema
/// differ, because these are equal for all cases of one run. If `keep_apart` is false, a conflict throws
/// InputError, which names both journals and what differs. If it is true, the conflicting rows of a journal
/// go to a folder apart-N.
///
/// Also throws InputError for a row whose experiment or case cannot be the name of a file.
Merge plan_merge(const std::vector<FoundRow>& rows, bool keep_apart);

/// Writes the rows and copies their pictures. The pictures are CASE.png; if rows of several devices or hosts
/// are in one folder, CASE@DEVICE@HOST.png. `folder` must be empty or must not exist. The function first
/// writes into a temporary folder beside it, so that an interrupted merge leaves no incomplete results.
/// Returns the number of pictures. Throws InputError if the folder or a file cannot be written.
std::size_t write_merge(const Merge& merge, const std::filesystem::path& folder);

/// Throws InputError if `folder` is a file or a folder that is not empty.
void require_new_folder(const std::filesystem::path& folder);

}  // namespace pelage
