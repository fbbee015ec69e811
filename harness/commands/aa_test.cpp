// pelage aa-test: counts how often the test behind pelage compare decides wrongly or not at all on this
// machine.
#include "harness/commands/aa_test.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

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
  int equal = 200, slower = 100, frames = 12;
  TrialLimits limits;
};

struct Size {
  int width = 0, height = 0;
};

/// Returns the size of the same shape with `factor` times as many pixels.
Size scaled(const std::string& text, double factor) {
  Size size;
  if (std::sscanf(text.c_str(), "%5dx%5d", &size.width, &size.height) != 2 || size.width < 16 ||
      size.height < 16)
    throw InputError(fmt::format("--size '{}' is not WIDTHxHEIGHT; write for instance 400x300", text));
  return {int(std::lround(size.width * std::sqrt(factor))),
          int(std::lround(size.height * std::sqrt(factor)))};
}

/// Returns the scene of the experiment's case with this picture size.
Scene scene_with(const Experiment& experiment, const AaOptions& options, Size size) {
  Overrides overrides;
  overrides.model = options.model;
  overrides.axes = {{"layers", {options.layers}}, {"size", {fmt::format("{}x{}", size.width, size.height)}}};
  return scene_of(experiment, cases_of(experiment, preset_of(experiment, "quick"), overrides).front());
}

/// A side of the comparisons: a scene on a device.
struct SideScene {
  cl::Device device;
  std::shared_ptr<const FrameInput> input;
  ShellOptions options;
};

/// Returns the first check of a picture that does not hold, as text; "" if all hold.
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

TimePipeline timing_of(const SideScene& side, int frames) {
  return [&side, frames] {
    constexpr int warm_up = 3;
    Shells shells(side.device, side.input, side.options);
    for (int i = 0; i < warm_up; ++i) shells.frame();
    std::vector<double> times;
    times.reserve(std::size_t(frames));
    for (int i = 0; i < frames; ++i) times.push_back(shells.frame().wall_ms);
    return times;
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
  const Size plain = scaled(options.size, 1), larger = scaled(options.size, 1 + work);
  Progress progress(std::size_t(options.equal + options.slower));
  const auto mesh = load_scene_mesh(scene_with(experiment, options, plain),
                                    [&](const std::string& text) { progress.note("  " + text); });
  const auto side_of = [&](Size size) {
    return SideScene{device, prepare(scene_with(experiment, options, size), mesh), {}};
  };
  const SideScene a = side_of(plain), b = side_of(larger);
  for (const SideScene* side : {&a, &b})
    if (const std::string failed = failed_check(*side); !failed.empty()) {
      fmt::print(stderr, "pelage: {}x{}: the picture fails its check: {}\n", side->input->scene.image.width,
                 side->input->scene.image.height, failed);
      return 1;
    }

  const TimePipeline time_a = timing_of(a, options.frames), time_b = timing_of(b, options.frames);
  std::mt19937_64 random(options.limits.seed);
  const auto now_s = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  std::vector<Trial> equal, slower;
  const CpuWatch watch;
  // The two kinds of trials take turns, so that a busy period affects both.
  for (int i = 0; i < std::max(options.equal, options.slower); ++i) {
    const auto trial = [&](const char* name, const TimePipeline& side, std::vector<Trial>& trials) {
      progress.start(name);
      trials.push_back(run_trial(time_a, side, options.limits, random, now_s));
      progress.finish(fmt::format("{:+.2f}%", 100 * std::expm1(trials.back().difference.log_ratio)));
    };
    if (i < options.equal) trial("equal sides", time_a, equal);
    if (i < options.slower) trial("more pixels", time_b, slower);
  }

  const double pixels = double(larger.width) * larger.height / plain.width / plain.height - 1;
  fmt::print("{}, {} layers, {}x{}; {} pipelines a side with {} timed frames each; threshold {}, alpha {}\n",
             options.model, options.layers, plain.width, plain.height, options.limits.rounds, options.frames,
             options.threshold, options.alpha);
  if (!equal.empty()) {
    const TrialCounts counts = count_of(equal);
    fmt::print("equal sides: {} called different: {} faster, {} slower\n",
               rate_text(counts.faster + counts.slower, counts.all()), counts.faster, counts.slower);
  }
  if (!slower.empty()) {
    const TrialCounts counts = count_of(slower);
    std::vector<double> changes;
    changes.reserve(slower.size());
    for (const Trial& t : slower) changes.push_back(std::expm1(t.difference.log_ratio));
    fmt::print(
        "{:.2f}% more pixels ({}x{}): {} called slower, {} faster, {} same, {} undecided; "
        "median change {:+.2f}%\n",
        100 * pixels, larger.width, larger.height, rate_text(counts.slower, counts.all()), counts.faster,
        counts.same, counts.undecided, 100 * median(changes));
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
      "aa-test", "Test the verdicts of compare on this machine: equal sides, and one side with more work");
  const auto count = [&](const char* name, int& value, const char* help, int least) {
    command->add_option(name, value, help)
        ->type_name("N")
        ->check(CLI::Range(least, 100000))
        ->capture_default_str();
  };
  const auto text = [&](const char* name, std::string& value, const char* help, const char* type) {
    command->add_option(name, value, help)->type_name(type)->capture_default_str();
  };
  count("--equal", options->equal, "Number of comparisons of equal sides", 0);
  count("--slower", options->slower, "Number of comparisons whose second side draws more pixels", 0);
  count("--rounds", options->limits.rounds, "Pipelines per side and comparison; the sides take turns",
        int(fewest_processes));
  count("--frames", options->frames, "Timed frames of each pipeline", 1);
  text("--work", options->work, "Additional pixels of the slower side", "5%");
  text("--threshold", options->threshold, "As in pelage compare", "0");
  text("--alpha", options->alpha, "As in pelage compare", "2%");
  text("--model", options->model, "Model or mesh file", "NAME|FILE");
  text("--layers", options->layers, "Number of layers", "N");
  text("--size", options->size, "Size of the picture", "WIDTHxHEIGHT");
  text("--device", options->device, "Device to use: PLATFORM:INDEX, or part of its name", "DEVICE");
  command->add_option("--seed", options->limits.seed, "Seed of the random order of the sides")
      ->type_name("N")
      ->capture_default_str();
  text("--csv", options->csv, "Write one line per comparison into this file", "FILE");
  command->callback([options, &chosen] { chosen = [options] { return aa_test(*options); }; });
}

}  // namespace pelage
