// The command-line options of pelage run, and functions that need only these options.
#pragma once
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/experiment/experiment.hpp"

namespace pelage {

struct RunOptions {
  std::vector<std::string> experiments, set, axis;
  std::string preset = "quick", device, model, up, reading, filter, shard, tuning = "defaults", mapping,
              output, resume, balance, host, quiet_machine;
  double budget_s = std::numeric_limits<double>::infinity();
  int repeat = 1;
  /// Index of this process among the processes that --repeat starts, from 0; -1 if the user started this
  /// process.
  int repeat_index = -1;
  std::optional<std::uint64_t> order_seed;
  bool dry_run = false, anonymous = false;
  std::vector<std::string> argv;  ///< command line of this process, beginning with the program's name

  Overrides overrides() const;             ///< throws InputError for a malformed key=value
  std::optional<Shard> own_shard() const;  ///< nothing without --shard
  std::filesystem::path folder() const;    ///< value of --resume or -o; otherwise the path of a new folder,
                                           ///< named after the time and the host
};

/// Declares all options of pelage run.
void declare(CLI::App& command, RunOptions& options);

/// Declares the options that select or change the cases of an experiment: --preset, --model, --reading,
/// --set,
/// --axis, --filter.
void declare_cases(CLI::App& command, RunOptions& options);

/// Returns the options with argv. Throws InputError for options that contradict each other, are malformed, or
/// name a missing file or folder.
RunOptions checked(RunOptions options);

/// Returns the cases of the preset whose names match `filter`. Throws InputError if there are none.
std::vector<Case> chosen_cases(const Experiment& experiment, const std::string& preset,
                               const std::string& filter, const Overrides& overrides = {});

/// Runs this program in a new process with these words after the program's name, and returns its exit code.
/// The new process ends when this one ends. Throws InputError if the system cannot start it.
int run_self(const std::vector<std::string>& words);

/// Runs this program in options.repeat new processes, one after another. Each process has its own
/// --repeat-index. Returns the first exit code that is not 0, or 0 if every process ended with 0. After an
/// exit code of 2 or more, the function starts no further process.
int run_repeats(const RunOptions& options, const std::filesystem::path& folder);

}  // namespace pelage
