// The commands of pelage. Each command NAME has a function add_NAME(app, chosen), which main() calls; related
// commands share a file. add_NAME declares the command and its options on `app`; --help describes them. If
// the command line names the command, CLI11 calls the command's callback. The callback stores a function in
// `chosen`, and main() then runs the stored function. The stored function returns the exit code:
// - 0: success;
// - 1: a check failed: a difference to the reference is too large (check), a case has another status than
//   `ok` (run), a case is left out because its picture is wrong (profile), a stage is not tuned because its
//   output with the default values is wrong (tune), or a device cannot be measured (devices);
// - 4: pelage merge found that shards (parts of a run) or cases are missing;
// - 5: pelage compare --fail-on-regression found that a case became slower or has no time.
// If the function throws, main() returns exit code 2 for InputError, 3 for NoDeviceError, and 1 for every
// other exception. Commands write data to stdout and messages to stderr. add_devices() in list.cpp is a short
// example.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pelage {

using Chosen = std::function<int()>;

/// Adds a command that runs `run` with its options. Returns the command and the options, on which the caller
/// declares the command's options.
template <class Options>
std::pair<CLI::App&, Options&> add_command(CLI::App& app, Chosen& chosen, const char* name, const char* help,
                                           int (*run)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(name, help);
  command->callback([=, &chosen] { chosen = [=] { return run(*options); }; });
  return {*command, *options};
}

/// Adds an option or a positional argument with a value. `type` says in --help what the value is. --help also
/// shows the default of a number or a text.
template <class T>
CLI::Option* add_value(CLI::App& command, const char* names, T& value, const char* type,
                       const std::string& help) {
  CLI::Option* option = command.add_option(names, value, help)->type_name(type);
  constexpr bool shown = std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;
  return shown ? option->capture_default_str() : option;
}

inline void add_device_option(CLI::App& command, std::string& device) {
  add_value(command, "--device", device, "DEVICE", "Device to use: PLATFORM:INDEX, or part of its name");
}

/// `purpose`: what the mapping is for, and the default.
void add_mapping_option(CLI::App& command, std::string& mapping, const std::string& purpose);

inline void add_tuning_option(CLI::App& command, std::string& tuning) {
  add_value(command, "--tuning", tuning, "defaults|FILE",
            "Values of the kernels' tuning axes: the defaults, or a file that `pelage tune` wrote");
}

inline void add_filter_option(CLI::App& command, std::string& filter) {
  add_value(command, "--filter", filter, "REGEX",
            "Use only the cases whose names match this regular expression");
}

inline void add_results_option(CLI::App& command, std::vector<std::string>& results) {
  add_value(command, "results", results, "RESULTS", "Folders with results, or journal files")->required();
}

/// Returns whether `pelage diagram KIND` writes a table, which can be drawn as SVG, and not a picture.
bool draws_table(const std::string& kind);

// The functions that add the commands. `app` must exist as long as the chosen function of add_manual().
using AddCommand = void(CLI::App& app, Chosen& chosen);
AddCommand add_devices, add_scene, add_render, add_animate, add_diagram, add_groom, add_mesh, add_topology,
    add_water, add_check, add_tune, add_profile, add_list, add_run, add_merge, add_export, add_compare,
    add_report, add_claims, add_reproduce, add_manual;

}  // namespace pelage
