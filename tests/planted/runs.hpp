// What the tests of this folder share: short runs of the pelage binary, copied into a folder per test, and
// changes of their files and rows. docs/trust.md lists the tests.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/journal/all_results.hpp"
#include "harness/report/cells.hpp"
#include "tests/cli/shell.hpp"

namespace pelage::planted {

using cli::Folder;
using cli::Outcome;

/// Returns an experiment with the given lines in its table [axes] and [scene]. A case has six timed frames.
std::string experiment(const std::string& axes, const std::string& scene);

/// The experiment of the run "base": a torus with 4 and with 8 layers, in moving air.
std::string base_experiment(const std::string& length = "0.1");

/// A folder with a copy of a short run. Each run is made once and then copied: experiment own.toml, results
/// in results/.
///   base   base_experiment()
///   other  the same with another length of the fur
///   files  a mesh file own.obj, a mesh file buffered.gltf with its buffer own.bin, and a coat own.png
class Runs : public ::testing::Test {
 protected:
  /// Copies the run into the folder; `results` is the new name of its results.
  void take(const std::string& run, const std::string& results = "results");
  Outcome resume(const std::string& options = "", const std::string& environment = "") {
    return cli::pelage(folder, options + " run own.toml --resume results", environment);
  }
  std::filesystem::path path(const std::string& name) const { return folder.path() / name; }
  /// Replaces `from`, which must occur, in a file of the folder.
  void edit(const std::string& file, const std::string& from, const std::string& to) const;
  /// Copies the kernels into the folder mine, and replaces `from` in one of their files.
  void edit_kernel(const std::string& file, const std::string& from, const std::string& to) const;
  /// The only journal of a folder of results.
  std::filesystem::path journal(const std::string& results = "results") const;
  std::vector<Row> rows(const std::string& results = "results") const;
  /// Changes the rows of the journal and seals them with new checksums.
  void reseal(const std::function<void(Row&)>& change, const std::string& results = "results") const;

  /// Expects that every command that reads the results refuses them, with a message that contains `text`.
  void expect_unreadable(const std::string& text);

  Folder folder;
};

/// The suite of the ways to get a wrong number.
class Planted : public Runs {};

/// Expects that pelage refused its input: exit code 2, and one message on stderr, which contains `text`.
void expect_refused(const Outcome& outcome, const std::string& text);

/// Returns the message of the InputError that `work` throws; "" if it throws none.
std::string refusal_of(const std::function<void()>& work);

/// Returns what differs in each further set of rows that a report of these results keeps apart
/// (input_sets()).
std::vector<std::string> kept_apart(const std::vector<std::filesystem::path>& results);

/// Returns the cells of a report of these results.
std::vector<Cell> cells_in(const std::vector<std::filesystem::path>& results);

}  // namespace pelage::planted
