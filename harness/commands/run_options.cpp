#include "harness/commands/run_options.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "harness/commands/scene_options.hpp"
#include "harness/error.hpp"
#include "harness/measure/provenance.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::pair<std::string, std::string> key_and_value(const std::string& text, std::string_view option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(fmt::format("{} '{}' is not key=value", option, text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// Splits "A,B,C" at its commas. Commas inside brackets belong to a vector: "[1,0,0],[0,1,0]" has two parts.
std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += (c == '[') - (c == ']');
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::vector<std::string> own_argv() {
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(stream, word, '\0');) words.push_back(word);
  return words;
}

}  // namespace

Overrides RunOptions::overrides() const {
  Overrides result;
  if (!up.empty()) result.set.emplace_back("mesh.up", up);
  for (const std::string& text : set) result.set.push_back(key_and_value(text, "--set"));
  for (const std::string& text : axis) {
    const auto [key, values] = key_and_value(text, "--axis");
    result.axes.push_back({key, split(values)});
    for (const std::string& value : result.axes.back().values)
      if (value.find_first_not_of(" \t") == std::string::npos)
        throw InputError(
            fmt::format("--axis '{}' has an empty value; write for instance layers=16,64", text));
  }
  result.model = model;
  result.reading = reading;
  return result;
}

std::optional<Shard> RunOptions::own_shard() const {
  return shard.empty() ? std::nullopt : std::optional(shard_from_text(shard));
}

fs::path RunOptions::folder() const {
  if (!resume.empty()) return resume;
  if (!output.empty()) return output;
  return fs::path("pelage-results") /
         fmt::format("{}-{}", utc_stamp(), anonymous ? "anonymous" : file_name_of(host_name()));
}

void declare_cases(CLI::App& command, RunOptions& options) {
  add_value(
      command, "--preset", options.preset, "NAME",
      "Preset: smoke runs for a few seconds; quick times every case with few samples; paper takes as many samples as a publication needs");
  add_value(command, "--model", options.model, "NAME|FILE",
            "Model or mesh file that replaces the experiment's models");
  add_up_option(command, options.up);
  add_reading_option(command, options.reading);
  add_value(command, "--set", options.set, "key=value", "Override a key of the scene")->take_all();
  add_value(command, "--axis", options.axis, "key=a,b",
            "Use these values of an axis instead of the experiment's values")
      ->take_all();
  add_filter_option(command, options.filter);
}

void declare(CLI::App& command, RunOptions& options) {
  add_value(command, "experiment", options.experiments, "EXPERIMENT|FILE.toml",
            "Experiments or collections of experiments: names that `pelage list` shows, or FILE.toml")
      ->required();
  declare_cases(command, options);
  add_value(command, "--device", options.device, "DEVICE",
            "Device to use: PLATFORM:INDEX, part of its name, or all");
  add_value(command, "--shard", options.shard, "i/n",
            "Run only every n-th case, beginning with case i (from 0)");
  add_value(
      command, "--balance", options.balance, "RESULTS",
      "With --shard: use the times in these earlier results to divide the cases into shards that take about the same time");
  command.add_option("--repeat", options.repeat, "Run all cases in each of N new processes")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  add_mapping_option(
      command, options.mapping,
      "Mapping of pixels to work-items if the experiment names none (default: depends on the device)");
  add_tuning_option(command, options.tuning);
  const std::map<std::string, double> seconds{{"s", 1}, {"m", 60}, {"h", 3600}};
  command
      .add_option("--budget", options.budget_s,
                  "Longest wall-clock time of the whole run, for instance 90s, 5m or 1h")
      ->transform(CLI::AsNumberWithUnit(seconds).description(""))
      ->check([](const std::string& time) {
        return time.starts_with('-') ? "the time " + time + " s is negative; write for instance 90s, 5m or 1h"
                                     : std::string();
      })
      ->type_name("TIME");
  add_value(command, "-o,--output", options.output, "DIR", "New folder for the results");
  add_value(command, "--resume", options.resume, "DIR",
            "Continue the interrupted run in this folder; its finished rows are kept");
  add_value(command, "--order-seed", options.order_seed, "N",
            "Seed of the random order of the cases, as recorded in the rows of an earlier run")
      ->check([](const std::string& seed) {
        return seed.starts_with('-') ? "the seed " + seed + " is negative; give a whole number of at least 0"
                                     : std::string();
      });
  add_value(
      command, "--host", options.host, "NAME",
      "Name of the host in the rows (default: the name of this machine). If nodes of a cluster have equal hardware, give all of them the same name, so that their rows are in one table");
  add_value(
      command, "--quiet-machine", options.quiet_machine, "warn|require",
      "Before each case, measure for one second whether other processes use more than 10% of the machine's CPU time. If they do, warn prints a warning, and require waits until they use less; if they still use more after a minute, require ends the run with code 1")
      ->check(CLI::IsMember({"warn", "require"}));
  command.add_flag("--anonymous", options.anonymous, "Write neither the host's name nor paths into the rows");
  command.add_flag("--dry-run", options.dry_run, "Print the cases without running them");
  command.add_option("--repeat-index", options.repeat_index)->group("");
}

RunOptions checked(RunOptions options) {
  options.argv = own_argv();
  if (!options.output.empty() && !options.resume.empty())
    throw InputError("give -o or --resume, but not both; --resume DIR also writes into DIR");
  if (!options.resume.empty() && !fs::is_directory(options.resume))
    throw InputError(fmt::format("--resume {}: no such folder", options.resume));
  if (options.tuning != "defaults" && !fs::is_regular_file(options.tuning))
    throw InputError(fmt::format("--tuning {}: no such file", options.tuning));
  options.own_shard();
  if (!options.balance.empty() && options.shard.empty())
    throw InputError("--balance divides the cases among shards; give also --shard i/n, such as --shard 0/4");
  options.overrides();
  return options;
}

std::vector<Case> chosen_cases(const Experiment& experiment, const std::string& preset,
                               const std::string& filter, const Overrides& overrides) {
  std::vector<Case> cases = filtered(cases_of(experiment, preset_of(experiment, preset), overrides), filter);
  if (cases.empty())
    throw InputError(fmt::format("{}: --filter '{}': no case of the preset {} has a name that matches",
                                 experiment.name, filter, preset));
  return cases;
}

int run_self(const std::vector<std::string>& given) {
  std::vector<std::string> words{"pelage"};
  words.insert(words.end(), given.begin(), given.end());
  const pid_t child = fork();
  if (child < 0) throw InputError("the system cannot start another process");
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // the child ends when its parent ends
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    execv("/proc/self/exe", argv.data());
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

int run_repeats(const RunOptions& options, const fs::path& folder) {
  int result = 0;
  for (int index = 0; index < options.repeat; ++index) {
    std::vector<std::string> words = options.argv;
    words.insert(words.end(), {"--repeat-index", std::to_string(index)});
    if (options.output.empty() && options.resume.empty()) words.insert(words.end(), {"-o", folder.string()});
    fmt::print(stderr, "pelage: process {} of {}\n", index + 1, options.repeat);
    const int code = run_self({words.begin() + 1, words.end()});
    if (result == 0) result = code;
    if (code >= 2) break;
  }
  return result;
}

}  // namespace pelage
