// Reads the rows of journals. A journal is a file of results, and each of its rows is the result of one case.
// Also lists the parts of the journals that contribute no row, such as copies of rows and incomplete lines.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/results_folder.hpp"

namespace pelage {

/// The rows of a journal, and the parts of the file that contribute no row.
struct JournalContents {
  std::vector<Row> rows;      ///< as read_journal() returns them
  std::vector<Row> replaced;  ///< rows with the status error; later rows of this journal replace them
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

/// Returns the rows that read_results() returns. Also returns a list of everything else in the journals:
/// copies of rows, rows that have the status error and are replaced by later rows, incomplete last lines, and
/// journals without a row. Throws the same exceptions as read_results(). For example, both functions throw
/// InputError if two rows of different measurements have equal frame times. One of these rows must then be a
/// changed copy of the other row, because measured times are never all equal.
Results read_all_results(const std::vector<std::string>& places);

}  // namespace pelage
