// The options of pelage run, and what follows from them alone.
#pragma once
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/commands/command.hpp"
#include "harness/experiment/experiment.hpp"

namespace pelage {

struct RunOptions {
  std::vector<std::string> experiments, set, axis;
  std::string preset = "quick", device, model, filter, shard, tuning = "defaults", mapping, output, resume;
  double budget_s = std::numeric_limits<double>::infinity();
  int repeat = 1;
  int repeat_index = -1;  ///< which process of --repeat this is; -1: none of them
  std::optional<std::uint64_t> order_seed;
  bool dry_run = false, anonymous = false;
  std::vector<std::string> argv;  ///< as the program was called

  Overrides overrides() const;  ///< throws InputError for a malformed key=value
  Shard shard_or_all() const;
  std::filesystem::path folder() const;  ///< --resume, -o, or a new one named after the time and the host
};

void declare(CLI::App& command, RunOptions& options);

/// Throws InputError for what can be told from the options alone; notes argv.
void check_options(RunOptions& options);

/// Runs this program options.repeat times, each time a fresh process with its own --repeat-index. The exit
/// code is the first that is not 0, after all have run; input errors end it at once.
int run_repeats(const RunOptions& options, const std::filesystem::path& folder);

}  // namespace pelage
