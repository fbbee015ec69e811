// Folders of results: which there are, and all rows that they hold.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/journal/row.hpp"

namespace pelage {

/// A row and the journal that holds it.
struct FoundRow {
  Row row;
  std::filesystem::path journal;
};

/// Every row of journals (*.jsonl) and of folders that hold some at any depth, in the order of their paths.
/// Throws InputError: a place that does not exist, that holds no journal, a damaged journal.
std::vector<FoundRow> read_results(const std::vector<std::string>& places);

/// The repository's results/ holds recordings: nothing is run into it. Throws InputError.
void refuse_recordings(const std::filesystem::path& folder);

}  // namespace pelage
