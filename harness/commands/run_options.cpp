#include "harness/commands/run_options.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "harness/error.hpp"
#include "harness/journal/provenance.hpp"
#include "harness/shells/opencl/shells.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::pair<std::string, std::string> key_and_value(const std::string& text, std::string_view option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(fmt::format("{} '{}' is not key=value", option, text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// A,B,C; commas inside brackets belong to a vector: [1,0,0],[0,1,0].
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
  for (const std::string& text : set) result.set.push_back(key_and_value(text, "--set"));
  for (const std::string& text : axis) {
    const auto [key, values] = key_and_value(text, "--axis");
    result.axes.push_back({key, split(values)});
  }
  result.model = model;
  return result;
}

Shard RunOptions::shard_or_all() const {
  return shard.empty() ? Shard{} : shard_from_text(shard);
}

fs::path RunOptions::folder() const {
  if (!resume.empty()) return resume;
  if (!output.empty()) return output;
  return fs::path("pelage-results") /
         fmt::format("{}-{}", utc_stamp(), anonymous ? "anonymous" : file_name_of(host_name()));
}

void declare(CLI::App& command, RunOptions& options) {
  command.add_option("experiment", options.experiments, "Names that `pelage list` shows, or FILE.toml")
      ->required()
      ->type_name("EXPERIMENT|FILE.toml");
  command
      .add_option("--preset", options.preset,
                  "smoke: seconds; quick: every cell, few samples; paper: to publish")
      ->type_name("NAME")
      ->capture_default_str();
  command.add_option("--device", options.device, "PLATFORM:INDEX, part of a device's name, or all")
      ->type_name("DEVICE");
  command.add_option("--model", options.model, "This model or mesh file in place of the experiment's")
      ->type_name("NAME|FILE");
  command.add_option("--set", options.set, "Override a key of the scene")->type_name("key=value")->take_all();
  command.add_option("--axis", options.axis, "Values of an axis in place of the experiment's")
      ->type_name("key=a,b")
      ->take_all();
  command.add_option("--filter", options.filter, "Only the cases whose name holds a match")
      ->type_name("REGEX");
  command.add_option("--shard", options.shard, "Every n-th case from the i-th on, i from 0")
      ->type_name("i/n");
  command.add_option("--repeat", options.repeat, "Fresh processes that run all of it")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  command
      .add_option("--mapping", options.mapping,
                  "How the shells' pixels are spread over work-items, where the experiment does not say "
                  "(default: what "
                  "suits the device): " +
                      mappings_help())
      ->check(CLI::IsMember(mappings()))
      ->type_name("NAME");
  command.add_option("--tuning", options.tuning, "Values of the kernels' tuning axes")
      ->type_name("defaults|FILE")
      ->capture_default_str();
  const std::map<std::string, double> seconds{{"s", 1}, {"m", 60}, {"h", 3600}};
  command.add_option("--budget", options.budget_s, "Wall clock for all of it: 90s, 5m, 1h")
      ->transform(CLI::AsNumberWithUnit(seconds).description(""))
      ->check(CLI::NonNegativeNumber.description(""))
      ->type_name("TIME");
  command.add_option("-o,--output", options.output, "New folder of results")->type_name("DIR");
  command.add_option("--resume", options.resume, "Go on in this folder; what it holds is kept")
      ->type_name("DIR");
  command.add_option("--order-seed", options.order_seed, "Replays a recorded order of the cases")
      ->type_name("N");
  command.add_flag("--anonymous", options.anonymous, "Leave the host's name and paths out of the rows");
  command.add_flag("--dry-run", options.dry_run, "Print the cases, run nothing");
  command.add_option("--repeat-index", options.repeat_index)->group("");
}

void check_options(RunOptions& options) {
  options.argv = own_argv();
  if (!options.output.empty() && !options.resume.empty())
    throw InputError("give -o or --resume, not both: --resume DIR goes on in DIR");
  if (!options.resume.empty() && !fs::is_directory(options.resume))
    throw InputError(fmt::format("--resume {}: no such folder", options.resume));
  if (options.tuning != "defaults" && !fs::is_regular_file(options.tuning))
    throw InputError(fmt::format("--tuning {}: no such file", options.tuning));
  options.shard_or_all();
  options.overrides();
}

int run_repeats(const RunOptions& options, const fs::path& folder) {
  int result = 0;
  for (int index = 0; index < options.repeat; ++index) {
    std::vector<std::string> words = options.argv;
    words.insert(words.end(), {"--repeat-index", std::to_string(index)});
    if (options.output.empty() && options.resume.empty()) words.insert(words.end(), {"-o", folder.string()});
    fmt::print(stderr, "pelage: process {} of {}\n", index + 1, options.repeat);
    const pid_t child = fork();
    if (child < 0) throw InputError("no further process can be started");
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGTERM);  // whoever ends the parent ends the sweep
      std::vector<char*> argv;
      argv.reserve(words.size() + 1);
      for (std::string& word : words) argv.push_back(word.data());
      argv.push_back(nullptr);
      execv("/proc/self/exe", argv.data());
      _exit(127);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
    if (result == 0) result = code;
    if (code >= 2) break;
  }
  return result;
}

}  // namespace pelage
