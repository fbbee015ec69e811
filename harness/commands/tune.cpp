// pelage tune: finds the fastest values of the kernels' tuning axes on a device. A tuning axis is a parameter
// of a kernel that affects only its speed, such as the width of a tile.
#include <fmt/format.h>

#include <cstdio>
#include <iterator>

#include "harness/atomic_file.hpp"
#include "harness/cl/program.hpp"
#include "harness/commands/commands.hpp"
#include "harness/commands/run_options.hpp"
#include "harness/error.hpp"
#include "harness/measure/provenance.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/record/results_folder.hpp"
#include "harness/tuning/contenders.hpp"
#include "harness/version/version.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

// Default value of --filter. It selects three cases: one with few large triangles (torus-16), one with many
// layers (torus-64) and one with many small triangles (bunny-16).
constexpr const char* default_scenes = "^(torus-16|torus-64|bunny-16)-800x600$";

struct TuneOptions {
  std::vector<std::string> stages;
  std::string device, preset = "quick", filter = default_scenes, output;
  int rounds = 9;
  bool dry_run = false;
};

struct NamedInput {
  std::string name;
  std::shared_ptr<const FrameInput> input;
};

std::vector<NamedInput> prepared(const Experiment& experiment, const std::vector<Case>& cases) {
  std::vector<NamedInput> inputs;
  for (const Case& which : cases) {
    const Scene scene = scene_of(experiment, which);
    const auto note = [](const std::string& what) { fmt::print(stderr, "  {}\n", what); };
    inputs.push_back({which.name, prepare(scene, load_scene_mesh(scene, note))});
  }
  return inputs;
}

std::string outcome_of(const Candidate& c) {
  if (!c.fault.empty()) return "failed: " + c.fault;
  return fmt::format("{:.3f} ({:.3f} to {:.3f}){}", c.ratio, c.interval.low, c.interval.high,
                     c.wins ? ", faster" : "");
}

void print_axes(const std::string& stage, const std::vector<TuningAxis>& axes) {
  for (const TuningAxis& axis : axes) {
    fmt::print("{}\t{}\t", stage, axis.name);
    fmt::print("{}", axis.shipped ? std::to_string(*axis.shipped) : "shipped");
    for (const int value : axis.values) fmt::print(",{}", value);
    fmt::print("\t{}\n", axis.what);
  }
}

std::string text_at(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void store(const fs::path& file, const std::string& stage, const TuningSearch& found,
           const std::string& kernel_hash, const cl::Device& device, const std::vector<NamedInput>& inputs) {
  const cl::DeviceInfo& info = device.info();
  std::string scenes;
  for (const NamedInput& i : inputs) scenes += (scenes.empty() ? "" : ", ") + i.name;
  const std::string against =
      found.best.empty() ? std::string("no other values were faster than the shipped ones")
                         : fmt::format("time relative to the shipped values: {:.3f} ({:.3f} to {:.3f})",
                                       found.last.ratio, found.last.interval.low, found.last.interval.high);
  const std::string note =
      fmt::format("{}, {}, driver {}; {}\npelage {}, kernels {}: {}\n{}", info.name, info.platform,
                  info.driver, utc_now(), build_info().revision.substr(0, 12), kernel_hash, against, scenes);
  const std::string text = with_stage(fs::exists(file) ? text_at(file) : "", stage, found.best, note);
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  write_text_atomically(file, text);
  // Checks that the written file can be read back; throws if it cannot.
  read_tuning(file);
}

int tune(const TuneOptions& options) {
  const std::vector<std::string> stages = options.stages.empty() ? tunable_stages() : options.stages;
  std::vector<std::vector<TuningAxis>> axes;
  axes.reserve(stages.size());
  for (const std::string& stage : stages) axes.push_back(tuning_axes(stage));
  const Experiment experiment = read_experiment(experiment_file("silva2010-table1"));
  const std::vector<Case> cases = chosen_cases(experiment, options.preset, options.filter);
  const cl::Device device = cl::choose_device(options.device);
  const fs::path file = options.output.empty()
                            ? fs::path("pelage-tuning") / (file_name_of(device.info().name) + ".toml")
                            : fs::path(options.output);
  refuse_recordings(file);
  if (fs::exists(file)) read_tuning(file);  // reports a malformed file now instead of after the search
  if (options.dry_run) {
    for (std::size_t i = 0; i < stages.size(); ++i) print_axes(stages[i], axes[i]);
    fmt::print(
        stderr,
        "pelage: nothing was run. Without --dry-run, pelage searches on {} for the fastest values, with the cases",
        device.info().name);
    for (const Case& c : cases) fmt::print(stderr, " {}", c.name);
    fmt::print(stderr, ", and stores these values in {}\n", file.string());
    return 0;
  }
  const std::vector<NamedInput> inputs = prepared(experiment, cases);
  fmt::print(
      "{}\nstage\tconfiguration\ttime divided by the time of the fastest configuration so far (95% interval)\n",
      device.info().name);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    std::vector<TuningScene> scenes;
    scenes.reserve(inputs.size());
    for (const NamedInput& n : inputs) scenes.push_back(tuning_scene(stages[i], n.name, device, n.input));
    const TuningSearch found =
        search_tuning(axes[i], scenes, options.rounds, [&stage = stages[i]](const Candidate& c) {
          fmt::print("{}\t{}\t{}\n", stage, text_of(c.tuning), outcome_of(c));
          std::fflush(stdout);
        });
    if (!found.fault.empty()) {
      fmt::print(stderr, "pelage: {}: the shipped values fail their check, so nothing is stored: {}\n",
                 stages[i], found.fault);
      return 1;
    }
    if (!found.last.tuning.empty())
      fmt::print("{}\t{}\ttime relative to the shipped values: {}{}\n", stages[i], text_of(found.last.tuning),
                 outcome_of(found.last), found.best.empty() ? "; dropped" : "");
    fmt::print("{}\t{}\tstored\n", stages[i], text_of(found.best));
    store(file, stages[i], found, scenes.front().make(found.best)->kernel_hash(), device, inputs);
  }
  fmt::print(stderr, "pelage: to use these values: pelage run --tuning {}\n", file.string());
  return 0;
}

}  // namespace

void add_tune(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<TuneOptions>(
      app, chosen, "tune",
      "Search, check and store the fastest values of the kernels' tuning axes on a device", tune);
  command.add_option("stages", options.stages, "Stages to tune: rasterize, simulate, wet (default: all)")
      ->type_name("STAGE");
  command.add_option("--device", options.device, "Device to use: PLATFORM:INDEX, or part of its name")
      ->type_name("DEVICE");
  command
      .add_option("--preset", options.preset,
                  "Preset of silva2010-table1 whose cases are timed: smoke, quick, paper")
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--filter", options.filter, "Use only the cases whose names match this regular expression")
      ->type_name("REGEX")
      ->capture_default_str();
  command
      .add_option("--rounds", options.rounds,
                  "Number of rounds in which each candidate is timed on each scene")
      ->type_name("N")
      ->check(CLI::Range(6, 1000))
      ->capture_default_str();
  command
      .add_option(
          "-o,--output", options.output,
          "File in which the values are stored; values of other stages in it are kept (default: pelage-tuning/DEVICE.toml)")
      ->type_name("FILE");
  command.add_flag("--dry-run", options.dry_run, "Print the axes without running anything");
}

}  // namespace pelage
