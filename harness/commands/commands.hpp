// The commands of pelage. Each command has one file NAME.cpp with a function add_NAME(app, chosen), which
// main() calls. add_NAME declares the command and its options on `app`; --help describes them. If the command
// line names the command, CLI11 calls the command's callback. The callback stores a function in `chosen`, and
// main() then runs the stored function. The stored function returns the exit code:
// - 0: success;
// - 1: a check failed: a difference to the reference is too large (check), a case has another status than
// `ok`
//   (run), a case is left out because its picture is wrong (profile), a stage is not tuned because its output
//   with the default values is wrong (tune), or a device cannot be measured (devices);
// - 4: pelage merge found that shards (parts of a run) or cases are missing;
// - 5: pelage compare --fail-on-regression found that a case became slower or has no time.
// If the function throws, main() returns exit code 2 for InputError, 3 for NoDeviceError, and 1 for every
// other exception. Commands write data to stdout and messages to stderr. The file
// harness/commands/devices.cpp is a short example.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <utility>

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

void add_devices(CLI::App& app, Chosen& chosen);
void add_scene(CLI::App& app, Chosen& chosen);
void add_render(CLI::App& app, Chosen& chosen);
void add_animate(CLI::App& app, Chosen& chosen);
void add_diagram(CLI::App& app, Chosen& chosen);
void add_mesh(CLI::App& app, Chosen& chosen);
void add_topology(CLI::App& app, Chosen& chosen);
void add_water(CLI::App& app, Chosen& chosen);
void add_check(CLI::App& app, Chosen& chosen);
void add_tune(CLI::App& app, Chosen& chosen);
void add_profile(CLI::App& app, Chosen& chosen);
void add_list(CLI::App& app, Chosen& chosen);
void add_run(CLI::App& app, Chosen& chosen);
void add_merge(CLI::App& app, Chosen& chosen);
void add_export(CLI::App& app, Chosen& chosen);
void add_compare(CLI::App& app, Chosen& chosen);
void add_report(CLI::App& app, Chosen& chosen);
void add_claims(CLI::App& app, Chosen& chosen);

/// `app` must exist as long as the chosen function of these two.
void add_completion(CLI::App& app, Chosen& chosen);
void add_manual(CLI::App& app, Chosen& chosen);

}  // namespace pelage
