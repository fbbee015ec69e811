// pelage aa-test: counts how often the statistical test of pelage compare gives a wrong verdict or no verdict
// on this machine. A comparison has two sides. Both sides draw the same scene, and their numbers of frames
// are equal or differ by a known amount.
#include "harness/commands/aa_test.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "harness/atomic_file.hpp"
#include "harness/commands/progress.hpp"
#include "harness/compare/windows.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/measure/aa_test.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/report/comparison.hpp"
#include "harness/shells/opencl/shells.hpp"

namespace pelage {
namespace {

constexpr const char* kExperiment = "silva2010-table1";

struct AaOptions {
  std::string model = "torus", size = "400x300", layers = "16", device, alpha = "2%", threshold = "0",
              work = "5%", csv;
  int equal = 200, slower = 100, frames = 20;
  TrialLimits limits;
};

struct Size {
  int width = 0, height = 0;
};

Size size_from_text(const std::string& text) {
  Size size;
  if (std::sscanf(text.c_str(), "%5dx%5d", &size.width, &size.height) != 2 || size.width < 16 ||
      size.height < 16)
    throw InputError(fmt::format("--size '{}' is not WIDTHxHEIGHT; write for instance 400x300", text));
  return size;
}

/// Returns the first scene of `experiment`, with the model and the number of layers of `options` and with a
/// picture of the size `size`.
Scene scene_with(const Experiment& experiment, const AaOptions& options, Size size) {
  Overrides overrides;
  overrides.model = options.model;
  overrides.axes = {{"layers", {options.layers}}, {"size", {fmt::format("{}x{}", size.width, size.height)}}};
  return scene_of(experiment, cases_of(experiment, preset_of(experiment, "quick"), overrides).front());
}

/// The scene, the device and the renderer options that both sides of a comparison use.
struct SideScene {
  cl::Device device;
  std::shared_ptr<const FrameInput> input;
  ShellOptions options;
};

/// Draws a frame and compares it with the reference picture. Returns a text that describes the first failed
/// check, or "" if no check fails.
std::string failed_check(const SideScene& side) {
  Shells shells(side.device, side.input, side.options);
  shells.frame();
  const WindowCheck result =
      check_against_reference(*side.input, shells.frames_simulated(), shells.read(), 1, {});
  if (result.checks.empty()) return "nothing was checked";
  for (const Check& check : result.checks)
    if (!check.holds()) return fmt::format("{} is {:g}, limit {:g}", check.metric, check.value, check.limit);
  return {};
}

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// One side of a round: a new pipeline, and the total time of its frames in ms.
struct Turn {
  Shells shells;
  double started_s = 0, sum_ms = 0;

  explicit Turn(const SideScene& side) : shells(side.device, side.input, side.options) {
    constexpr int warm_up = 3;
    for (int i = 0; i < warm_up; ++i) shells.frame();
  }
  void frame() {
    if (sum_ms == 0) started_s = now_s();
    sum_ms += shells.frame().wall_ms;
  }
};

/// Returns a function that makes two pipelines. The first draws `frames_a` frames and the second `frames_b`
/// frames, in turns. A side has one sample: the total time of its frames.
TimeRound in_turns(const SideScene& side, int frames_a, int frames_b) {
  return [&side, frames_a, frames_b](bool b_first) {
    std::optional<Turn> a, b;
    if (b_first) b.emplace(side);
    a.emplace(side);
    if (!b_first) b.emplace(side);
    for (int i = 0; i < std::max(frames_a, frames_b); ++i) {
      if (b_first && i < frames_b) b->frame();
      if (i < frames_a) a->frame();
      if (!b_first && i < frames_b) b->frame();
    }
    return RoundTimes{{a->sum_ms}, {b->sum_ms}, a->started_s, b->started_s};
  };
}

std::string rate_text(int hits, int all) {
  const Interval interval = rate_interval(hits, all);
  return fmt::format("{} of {} ({:.1f}%, 95% interval {:.1f}% to {:.1f}%)", hits, all, 100.0 * hits / all,
                     100 * interval.low, 100 * interval.high);
}

int aa_test(AaOptions options) {
  options.limits.threshold = fraction_from_text("--threshold", options.threshold);
  options.limits.alpha = fraction_from_text("--alpha", options.alpha);
  const double work = fraction_from_text("--work", options.work);
  if (!(options.limits.alpha > 0 && options.limits.alpha < 0.5))
    throw InputError(fmt::format("--alpha '{}' must be above 0 and below 50%", options.alpha));
  if (!options.csv.empty()) require_place(options.csv);
  const cl::Device device = cl::choose_device(options.device);
  const Experiment experiment = read_experiment(experiment_file(kExperiment));
  const Size size = size_from_text(options.size);
  const int more = int(std::lround(options.frames * (1 + work)));
  if (more == options.frames)
    throw InputError(
        fmt::format("--work '{}' adds less than half a frame to --frames {}", options.work, options.frames));
  Progress progress(std::size_t(options.equal + options.slower));
  const Scene scene = scene_with(experiment, options, size);
  const auto mesh = load_scene_mesh(scene, [&](const std::string& text) { progress.note("  " + text); });
  const SideScene side{device, prepare(scene, mesh), {}};
  if (const std::string failed = failed_check(side); !failed.empty()) {
    fmt::print(stderr, "pelage: the picture differs too much from the reference picture: {}\n", failed);
    return 1;
  }

  const TimeRound time_equal = in_turns(side, options.frames, options.frames),
                  time_slower = in_turns(side, options.frames, more);
  std::mt19937_64 random(options.limits.seed);
  std::vector<Trial> equal, slower;
  const CpuWatch watch;
  // Comparisons in which both sides draw equally many frames alternate with comparisons in which one side
  // draws more frames. A busy period of the machine therefore affects both kinds of comparisons.
  for (int i = 0; i < std::max(options.equal, options.slower); ++i) {
    const auto trial = [&](const char* name, const TimeRound& time_round, std::vector<Trial>& trials) {
      progress.start(name);
      trials.push_back(run_trial(time_round, options.limits, random));
      progress.finish(fmt::format("{:+.2f}%", 100 * std::expm1(trials.back().difference.log_ratio)));
    };
    if (i < options.equal) trial("equal sides", time_equal, equal);
    if (i < options.slower) trial("more frames", time_slower, slower);
  }

  fmt::print("{}, {} layers, {}x{}; {} pipelines per side, {} frames per pipeline; threshold {}, alpha {}\n",
             options.model, options.layers, size.width, size.height, options.limits.rounds, options.frames,
             options.threshold, options.alpha);
  if (!equal.empty()) {
    const TrialCounts counts = count_of(equal);
    fmt::print("equal sides wrongly called different: {}; {} faster, {} slower\n",
               rate_text(counts.faster + counts.slower, counts.all()), counts.faster, counts.slower);
  }
  if (!slower.empty()) {
    const TrialCounts counts = count_of(slower);
    std::vector<double> changes;
    changes.reserve(slower.size());
    for (const Trial& t : slower) changes.push_back(std::expm1(t.difference.log_ratio));
    fmt::print(
        "{} frames compared with {} frames: {} called slower, {} faster, {} same, {} undecided; median "
        "change {:+.2f}%\n",
        more, options.frames, rate_text(counts.slower, counts.all()), counts.faster, counts.same,
        counts.undecided, 100 * median(changes));
  }
  if (const auto share = watch.other_share())
    fmt::print("other processes used {:.1f}% of the machine's CPU time\n", 100 * *share);
  if (!options.csv.empty())
    write_text_atomically(options.csv,
                          trials_csv_header() + trials_csv("equal", equal) + trials_csv("slower", slower));
  return 0;
}

}  // namespace

void add_aa_test(CLI::App& app, Chosen& chosen) {
  auto options = std::make_shared<AaOptions>();
  CLI::App* command = app.add_subcommand(
      "aa-test",
      "Count wrong verdicts of pelage compare on this machine, for equal work and for a known amount of "
      "additional work");
  const auto count = [&](const char* name, int& value, const char* help, int least) {
    command->add_option(name, value, help)
        ->type_name("N")
        ->check(CLI::Range(least, 100000))
        ->capture_default_str();
  };
  const auto text = [&](const char* name, std::string& value, const char* help, const char* type) {
    command->add_option(name, value, help)->type_name(type)->capture_default_str();
  };
  count("--equal", options->equal, "Number of comparisons in which both sides draw the same frames", 0);
  count("--slower", options->slower, "Number of comparisons in which the second side draws more frames", 0);
  count(
      "--rounds", options->limits.rounds,
      "Number of rounds per comparison; in each round both sides make one pipeline and draw frames in turns",
      int(fewest_processes));
  count("--frames", options->frames, "Frames that each pipeline draws; their total time is the sample", 1);
  text("--work", options->work, "Additional frames of the slower side, relative to --frames", "5%");
  text("--threshold", options->threshold,
       "Largest relative change that counts as no change, as in pelage compare", "0");
  text("--alpha", options->alpha, "Largest probability of a wrong verdict, as in pelage compare", "2%");
  text("--model", options->model, "Name of a model, or path of a mesh file", "NAME|FILE");
  text("--layers", options->layers, "Number of layers", "N");
  text("--size", options->size, "Size of the picture in pixels", "WIDTHxHEIGHT");
  text("--device", options->device, "Device to use: PLATFORM:INDEX, or part of its name", "DEVICE");
  command->add_option("--seed", options->limits.seed, "Random seed of the order in which the two sides run")
      ->type_name("N")
      ->capture_default_str();
  text("--csv", options->csv, "Write one line per comparison into this file", "FILE");
  command->callback([options, &chosen] { chosen = [options] { return aa_test(*options); }; });
}

}  // namespace pelage
