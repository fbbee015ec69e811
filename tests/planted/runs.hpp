// Short runs of the pelage program, and copies of them, whose files and rows the tests change.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/record/results_folder.hpp"
#include "harness/report/cells.hpp"
#include "tests/cli/shell.hpp"

namespace pelage::planted {

using namespace cli;

/// Returns the experiment of the run "base": two cases, which draw a torus with 4 and with 8 layers of fur in
/// wind. `length` is the length of the fur.
std::string base_experiment(const std::string& length = "0.1");

/// A temporary folder with a copy of a short run. The run's experiment file is own.toml, and its results are
/// in results/. The tests make each of the following runs once. take() copies it:
/// - base: the experiment base_experiment()
/// - other: base_experiment("0.12"), with longer fur
/// - files: an experiment with the mesh files own.obj and buffered.gltf (buffer: own.bin) and the texture
///   own.png
struct Runs : InFolder {
  /// Copies the run into the folder. Its results are copied into a subfolder with the name `results`.
  void take(const std::string& run, const std::string& results = "results");
  Outcome resume(const std::string& options = "", const std::string& environment = "") {
    return pelage(options + " run own.toml --resume results", environment);
  }
  std::filesystem::path path(const std::string& name) const { return folder.path / name; }
  /// Copies the kernel sources into the subfolder `mine`, and replaces `from` by `to` in one of the copied
  /// files.
  void edit_kernel(const std::string& file, const std::string& from, const std::string& to) const;
  std::filesystem::path journal(const std::string& results = "results") const;
  std::vector<Row> rows(const std::string& results = "results") const;
  /// Applies `change` to each row of the journal, and writes the rows with correct checksums.
  void reseal(const std::function<void(Row&)>& change, const std::string& results = "results") const;

  /// Changes the rows of a copy of the run "base", whose frames then take longer. Expects that a report
  /// separates the copy from the run, because of the inputs `differs`, and that --resume refuses the copy.
  void expect_apart(const std::function<void(Row&)>& change, const std::string& differs,
                    const std::string& text);

  /// Expects that every command that reads the results refuses them, with a message that contains `text`.
  void expect_unreadable(const std::string& text);
};

/// The test suite for the first table of docs/results.md.
struct Planted : Runs {};

/// Expects that pelage refused its input. Lines about the preparation of a mesh may precede the message.
inline void refused(const Outcome& outcome, const std::string& text) {
  expect_refused(outcome, text, true);
}

/// Writes a picture of 2 x 2 pixels with this amount of red.
void write_red(const std::filesystem::path& file, float red);

/// Makes the times of the row's frames 1.5 times as long.
void slow_down(Row& row);

/// A report separates rows that measured different inputs into several sets (input_sets()). Returns one text
/// for each set except the first. The text names the inputs that differ from the first set.
std::vector<std::string> kept_apart(const std::vector<std::filesystem::path>& results);

/// Returns the table cells of a report of these results: each cell combines the rows of one case.
std::vector<Cell> cells_in(const std::vector<std::filesystem::path>& results);

}  // namespace pelage::planted
