// Reads journals completely: their rows, and everything in them that is not among the rows.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

/// The rows of a journal, and the parts of the file that are not among them.
struct JournalContents {
  std::vector<Row> rows;      ///< as read_journal() returns them
  std::vector<Row> replaced;  ///< rows with the status error that later rows of the journal replace
  std::size_t torn = 0;       ///< length of the last line in bytes, if it is not complete
};

/// Reads a journal like read_journal().
JournalContents read_contents(const std::filesystem::path& file);

/// A part of the given journals that is not among the rows, and the reason.
struct LeftOut {
  std::string experiment, case_name;  ///< "" if the part is not a row
  std::string where;                  ///< the journal; "" if the part is not in one journal
  std::string reason;
};

struct Results {
  std::vector<FoundRow> rows;
  std::vector<LeftOut> left_out;
};

/// Returns the rows of read_results(), and a list of everything else in the journals: copies of rows, rows
/// with the status error that later rows replace, last lines that are not complete, and journals without a
/// row. Throws like read_results(). Both functions also throw InputError if two rows of different
/// measurements have equal times, because one of them is then a changed copy.
Results read_all_results(const std::vector<std::string>& places);

}  // namespace pelage
