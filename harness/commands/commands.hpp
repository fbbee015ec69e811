// The commands of pelage. Each command has one file NAME.cpp with a function add_NAME(app, chosen),
// which main() calls. add_NAME declares the command's options on `app`. If the command line names the
// command, CLI11 calls the command's callback. The callback stores a function in `chosen`, and main() then
// runs the stored function. The stored function returns the exit code:
// - 0: success;
// - 1: a check failed;
// - 4: pelage merge found that shards (parts of a run) or cases are missing;
// - 5: pelage compare --fail-on-regression found that a case became slower or has no time.
// If the function throws, main() returns exit code 2 for InputError, 3 for NoDeviceError, and 1 for every
// other exception. Commands write data to stdout and messages to stderr. The file
// harness/commands/devices.cpp is a short example.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace pelage {

using Chosen = std::function<int()>;

/// pelage devices: lists the OpenCL devices. The exit code is 1 if the measurement of a device fails, and 3
/// if there is no device.
void add_devices(CLI::App& app, Chosen& chosen);

/// pelage scene: prints a scene with all overrides as TOML. Each key has a comment.
void add_scene(CLI::App& app, Chosen& chosen);

/// pelage render: draws one picture of a scene with a pipeline of renderers.hpp.
void add_render(CLI::App& app, Chosen& chosen);

/// pelage animate: draws the frames of an animation, and joins them to a GIF or MP4 file if asked to.
void add_animate(CLI::App& app, Chosen& chosen);

/// pelage diagram: draws the insets, sections and overlays of the papers' figures (docs/experiments.md).
void add_diagram(CLI::App& app, Chosen& chosen);

/// pelage mesh: prepares a mesh, and prints its numbers of vertices, edges and faces, its topology, the
/// repairs and the quality of its UV map.
void add_mesh(CLI::App& app, Chosen& chosen);

/// pelage topology: prints the numbers of masses and springs of each mass-spring topology on a model, and
/// draws the topologies.
void add_topology(CLI::App& app, Chosen& chosen);

/// pelage water: prints where the water of a scene is over time.
void add_water(CLI::App& app, Chosen& chosen);

/// pelage check: compares the results of a device with the double-precision reference, stage by stage. The
/// exit code is 1 if a difference exceeds its limit.
void add_check(CLI::App& app, Chosen& chosen);

/// pelage tune: times the values of the tuning axes of the kernels on a device, and stores the fastest for
/// `pelage run --tuning`. If the output of a stage with the default values is wrong, it stores no values for
/// this stage, skips the remaining stages and returns 1.
void add_tune(CLI::App& app, Chosen& chosen);

/// pelage profile: times the kernels of a frame. Leaves out each case whose picture fails its check; the exit
/// code is then 1.
void add_profile(CLI::App& app, Chosen& chosen);

/// pelage list: lists the experiments, or the cases of one experiment.
void add_list(CLI::App& app, Chosen& chosen);

/// pelage run: times the cases of experiments and prints the folder of the results. The exit code is 1 if
/// the result of a case has another status than `ok`, and 2 if a case has invalid input.
void add_run(CLI::App& app, Chosen& chosen);

/// pelage merge: writes the rows of shards (parts of a run) and of whole runs into a new folder, and prints
/// missing shards and cases.
void add_merge(CLI::App& app, Chosen& chosen);

/// pelage export: writes the rows of journals as CSV.
void add_export(CLI::App& app, Chosen& chosen);

/// pelage compare: compares the times of two sets of results. With --fail-on-regression the exit code is 5
/// if a case is slower in B or has no time in B.
void add_compare(CLI::App& app, Chosen& chosen);

/// pelage report: writes a report into a folder and prints its tables.
void add_report(CLI::App& app, Chosen& chosen);

/// pelage claims: prints whether recorded results support the claims of papers or of the user.
void add_claims(CLI::App& app, Chosen& chosen);

/// pelage completion: prints a script for bash that completes the commands, options and values of pelage.
/// `app` must exist as long as the chosen function.
void add_completion(CLI::App& app, Chosen& chosen);

/// pelage manual: prints the manual page with the descriptions of all commands. `app` must exist as long as
/// the chosen function.
void add_manual(CLI::App& app, Chosen& chosen);

}  // namespace pelage
