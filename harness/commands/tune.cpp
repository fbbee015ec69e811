// pelage tune finds the fastest values of the kernels' tuning axes on a device. A tuning axis is a parameter
// of a kernel that affects only its speed, such as the width of a tile. pelage profile prints the time of
// every kernel of a frame, and the size of the kernel's buffers in bytes.
#include <fmt/format.h>

#include <cstdio>

#include "harness/atomic_file.hpp"
#include "harness/base/toml_file.hpp"
#include "harness/cl/measure.hpp"
#include "harness/cl/program.hpp"
#include "harness/commands/commands.hpp"
#include "harness/commands/run_options.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/error.hpp"
#include "harness/measure/provenance.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/record/results_folder.hpp"
#include "harness/report/plot_spec.hpp"
#include "harness/report/profile.hpp"
#include "harness/system/system.hpp"
#include "harness/tuning/tuning.hpp"
#include "harness/tuning/tuning_search.hpp"
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
  const std::string text = with_stage(fs::exists(file) ? toml_text_of(file) : "", stage, found.best, note);
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
  add_value(command, "stages", options.stages, "STAGE",
            "Stages to tune: rasterize, simulate, wet (default: all)");
  add_device_option(command, options.device);
  add_value(command, "--preset", options.preset, "NAME",
            "Preset of silva2010-table1 whose cases are timed: smoke, quick, paper");
  add_filter_option(command, options.filter);
  add_value(command, "--rounds", options.rounds, "N",
            "Number of rounds in which each candidate is timed on each scene")
      ->check(CLI::Range(6, 1000));
  add_value(
      command, "-o,--output", options.output, "FILE",
      "File in which the values are stored; values of other stages in it are kept (default: pelage-tuning/DEVICE.toml)");
  command.add_flag("--dry-run", options.dry_run, "Print the axes without running anything");
}

namespace {

struct ProfileOptions {
  std::string experiment = "silva2010-table1", preset = "quick", device, mapping, tuning = "defaults", output;
  std::string filter = "^(torus-16|torus-64|bunny-16|lion-16)-800x600$";
  int frames = 15;
};

/// Returns the kernels in the order in which a frame runs them. The time of a kernel in a frame is the
/// sum over its launches. Each returned time is the median over the frames. The returned number of bytes of a
/// kernel is the sum over its launches in the first frame.
std::vector<KernelWork> kernels_of(const std::vector<cl::FrameTiming>& timings) {
  std::vector<KernelWork> kernels;
  std::vector<std::vector<double>> times;
  for (std::size_t i = 0; i < timings.size(); ++i)
    for (const cl::KernelTime& k : timings[i].kernels) {
      std::size_t at = 0;
      while (at < kernels.size() && (kernels[at].kernel != k.kernel || kernels[at].phase != k.phase)) ++at;
      if (at == kernels.size()) {
        kernels.push_back({k.kernel, k.phase});
        times.emplace_back(timings.size(), 0.0);
      }
      times[at][i] += k.ms;
      if (i == 0) kernels[at].bytes += double(k.bytes);
    }
  for (std::size_t at = 0; at < kernels.size(); ++at) kernels[at].ms = median(times[at]);
  return kernels;
}

/// Prints the checks that do not hold. Returns whether all hold.
bool all_hold(const Case& which, const std::vector<Check>& checks) {
  for (const Check& c : checks)
    if (!c.holds()) {
      fmt::print(
          stderr,
          "pelage: {}: the check of {} against {} found {:.6g}, but {} {:.6g} is required; this case is left out\n",
          which.name, c.metric, c.against, c.value, c.at_least ? "at least" : "at most", c.limit);
      return false;
    }
  return true;
}

/// Draws three warm-up frames, then times `frames` frames. If the picture fails its check against the
/// reference, prints the reason to stderr and returns an empty value.
std::optional<FrameWork> work_of(const Experiment& experiment, const Case& which,
                                 const BackendOptions& options, int frames) {
  const Scene scene = scene_of(experiment, which);
  // In studies such as "strands+opengl", the first part of the name draws on the device.
  const KnownBackend known =
      backend_named(std::string_view(which.pipeline).substr(0, which.pipeline.find('+')));
  if (!known || !known.kind->on_device)
    throw InputError(
        fmt::format("{}: the pipeline {} does not draw on an OpenCL device", which.name, which.pipeline));
  const auto backend = known.kind->open(options, scene);
  const auto mesh = load_scene_mesh(scene);
  backend->load(known.system->prepare(scene, mesh));
  backend->advance(frames_before(scene.dynamics));
  backend->begin_checks();
  for (int i = 0; i < 3; ++i) backend->frame();
  std::vector<cl::FrameTiming> timings;
  std::vector<double> wall;
  for (int i = 0; i < frames; ++i) {
    timings.push_back(backend->frame());
    wall.push_back(timings.back().wall_ms);
  }
  if (!all_hold(which, backend->checks(backend->read(), 1))) return {};
  const BackendWork work = backend->work();
  return FrameWork{which.name,         double(mesh->triangle.size()),
                   median(wall),       work.covered,
                   work.shaded,        work.blended,
                   kernels_of(timings)};
}

int profile(const ProfileOptions& options) {
  const Experiment experiment = read_experiment(experiment_file(options.experiment));
  const std::vector<Case> cases = chosen_cases(experiment, options.preset, options.filter);
  BackendOptions how{.mapping = options.mapping};
  if (options.tuning != "defaults") how.tuning = read_tuning(options.tuning);
  const fs::path folder = options.output;
  if (!folder.empty()) {
    refuse_recordings(folder);
    fs::create_directories(folder);
  }
  const cl::Device device = cl::choose_device(options.device);
  how.device = device;
  const cl::DeviceSpeed speed = cl::measure_device(device);
  if (!speed.timer.real)
    throw InputError(
        fmt::format("{}: {}: single kernels cannot be timed on this device; `pelage run` times whole frames",
                    device.info().name, speed.timer.reason));
  const Bandwidth bandwidth{device.info().name, speed.triad_gb_s};
  std::vector<FrameWork> frames;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    fmt::print(stderr, "{}/{} {}\n", i + 1, cases.size(), cases[i].name);
    if (auto work = work_of(experiment, cases[i], how, options.frames)) frames.push_back(std::move(*work));
  }
  fmt::print("{}", text_of(frames, bandwidth));
  if (!folder.empty() && !frames.empty()) {
    write_text_atomically(folder / "profile.csv", csv_of(frames, bandwidth));
    if (const std::string problem =
            draw_plot(plot_program("profile"), folder / "profile.csv", folder / "profile");
        !problem.empty())
      fmt::print(stderr, "pelage: {}\n", problem);
    fmt::print(stderr, "pelage: wrote the files profile.* to {}\n", options.output);
  }
  return frames.size() == cases.size() ? 0 : 1;
}

}  // namespace

void add_profile(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<ProfileOptions>(
      app, chosen, "profile",
      "Time the kernels of a frame, and compare their rates with the memory bandwidth of the device",
      profile);
  add_value(command, "experiment", options.experiment, "EXPERIMENT|FILE.toml",
            "Experiment whose scenes are drawn: a name that `pelage list` shows, or FILE.toml");
  add_value(command, "--preset", options.preset, "NAME", "Preset of the experiment; its cases are timed");
  add_filter_option(command, options.filter);
  add_device_option(command, options.device);
  add_mapping_option(command, options.mapping,
                     "Mapping of pixels to work-items (default: depends on the device)");
  add_tuning_option(command, options.tuning);
  add_value(command, "--frames", options.frames, "N",
            "Number of timed frames; the median of their times is reported")
      ->check(CLI::Range(1, 10000));
  add_value(command, "-o,--output", options.output, "DIR", "Folder for the table and the plot");
}

}  // namespace pelage
