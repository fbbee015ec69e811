// Reads the rows of journals, and also lists the parts of the journals that contribute no row, such as copies
// and incomplete lines.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// The rows of a journal, and the parts of the file that contribute no row.
struct JournalContents {
  std::vector<Row> rows;      ///< as read_journal() returns them
  std::vector<Row> replaced;  ///< rows with the status error whose case has a later row in the same journal
  std::size_t torn = 0;       ///< length of the last line in bytes if the line is incomplete, otherwise 0
};

/// Reads a journal like read_journal().
JournalContents read_contents(const std::filesystem::path& file);

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

/// Returns the rows that read_results() returns, and a list of everything else in the journals: copies of
/// rows, rows with the status error that later rows replace, incomplete last lines, and journals without a
/// row. Throws the same exceptions as read_results(). Both functions also throw InputError if rows of
/// different measurements have equal frame times, because one row is then a changed copy of the other.
Results read_all_results(const std::vector<std::string>& places);

}  // namespace pelage
