// pelage profile: prints a line for every kernel of a frame. The line contains the kernel's time and the size
// of the kernel's buffers in bytes.
#include "harness/report/profile.hpp"

#include <fmt/format.h>

#include "harness/atomic_file.hpp"
#include "harness/cl/measure.hpp"
#include "harness/commands/commands.hpp"
#include "harness/commands/run_options.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/record/results_folder.hpp"
#include "harness/report/plot.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/system/system.hpp"
#include "harness/tuning/tuning.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

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
  command
      .add_option("experiment", options.experiment,
                  "Experiment whose scenes are drawn: a name that `pelage list` shows, or FILE.toml")
      ->type_name("EXPERIMENT|FILE.toml")
      ->capture_default_str();
  command.add_option("--preset", options.preset, "Preset of the experiment; its cases are timed")
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--filter", options.filter, "Use only the cases whose names match this regular expression")
      ->type_name("REGEX")
      ->capture_default_str();
  command.add_option("--device", options.device, "Device to use: PLATFORM:INDEX, or part of its name")
      ->type_name("DEVICE");
  command
      .add_option("--mapping", options.mapping,
                  "Mapping of pixels to work-items (default: depends on the device): " + mappings_help())
      ->check(CLI::IsMember(mappings()))
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--tuning", options.tuning,
                  "Values of the kernels' tuning axes: the defaults, or a file that `pelage tune` wrote")
      ->type_name("defaults|FILE")
      ->capture_default_str();
  command
      .add_option("--frames", options.frames, "Number of timed frames; the median of their times is reported")
      ->type_name("N")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command.add_option("-o,--output", options.output, "Folder for the table and the plot")->type_name("DIR");
}

}  // namespace pelage
