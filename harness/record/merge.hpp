// Merges the rows of several folders of results, such as the shards of a run, into one new folder.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/results_folder.hpp"

namespace pelage {

/// A row, and the journal to which it is written, relative to the new folder: "EXPERIMENT/DEVICE@HOST.jsonl",
/// or "apart-2/EXPERIMENT/DEVICE@HOST.jsonl" for rows that conflict with rows in this journal (plan_merge()),
/// "apart-3/..." for rows that also conflict with those, and so on.
struct MergedRow {
  FoundRow found;
  std::filesystem::path journal;
};

struct Merge {
  std::vector<MergedRow> rows;  ///< the rows of one input journal stand together
  std::size_t copies = 0;       ///< number of rows left out because they are copies of other rows
  std::size_t replaced = 0;     ///< number of rows with the status error that other rows replace
  /// For each of the folders apart-2, apart-3, ...: the properties in which its rows differ from those with
  /// which they conflict.
  std::vector<std::string> apart;
};

/// Decides to which new journal each row of read_results() is written. Two rows go to the same new journal if
/// they have the same experiment and the names of their input journals are equal, apart from the shard
/// (".i-of-n"). A new journal contains at most one row for each case and each process that --repeat starts. A
/// row with the status error is left out if the same case has a row without an error or a later row with an
/// error.
///
/// Two rows conflict if they would have the same key in the same journal but are different measurements:
/// their identities differ, or they come from different runs. Rows of different cases in one journal also
/// conflict if they differ in a property that must be equal for all cases of a run: the device, its driver,
/// the kernels, the shaders, the OpenGL renderer, the build, the sampling limits, the preset, the CPU and the
/// schema.
///
/// If `keep_apart` is false and rows conflict, throws InputError with both journals and the properties that
/// differ. If it is true, a conflicting row goes to a separate folder, together with the rows of its input
/// journal that do not conflict with it.
///
/// Also throws InputError if the name of a row's experiment or case cannot be the name of a file.
Merge plan_merge(const std::vector<FoundRow>& rows, bool keep_apart);

/// Writes the rows and copies their pictures into `folder`, which must be empty or must not exist. The name
/// of a picture is CASE.png, or CASE@DEVICE@HOST.png if the experiment has rows of several devices or hosts.
/// The files are first written into a temporary folder, which is then renamed, so that an interrupted merge
/// leaves no incomplete results. Returns the number of pictures. Throws InputError if a file cannot be
/// written.
std::size_t write_merge(const Merge& merge, const std::filesystem::path& folder);

/// Throws InputError if `folder` is a file or a folder that is not empty.
void require_new_folder(const std::filesystem::path& folder);

}  // namespace pelage
