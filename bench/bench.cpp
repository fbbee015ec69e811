// pelage-bench: times every kernel of a frame, and the whole frame, with Google Benchmark. The times of
// kernels come from the device's own timer, and the times of frames are wall times. Google Benchmark's option
// --benchmark_out and its script compare.py work as usual.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <set>

#include "harness/cl/device.hpp"
#include "harness/cl/measure.hpp"
#include "harness/cl/program.hpp"
#include "harness/error.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/shells/opencl/wet_stage.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/shells/backends.hpp"
#include "harness/version/version.hpp"

namespace {

using namespace pelage;

struct Options {
  std::string device, scene, mapping;
  std::vector<std::string> set;
  double seconds = 0.5;
};

/// A scene that is timed. Each iteration of a benchmark draws one frame or computes one wetness mask. The
/// kernels' times come from their OpenCL events.
struct Bench {
  std::shared_ptr<const FrameInput> input;
  std::unique_ptr<Backend> backend;
  cl::Queue queue;
  shells::WetStage wet;
  BackendWork work;

  Bench(const cl::Device& device, std::shared_ptr<const FrameInput> from, const std::string& mapping)
      : input(std::move(from)),
        backend(shells::open_opencl({.device = device, .mapping = mapping}, input->scene)),
        queue(device),
        wet(queue, *input) {
    backend->load(input);
    backend->advance(frames_before(input->scene.dynamics));
    backend->frame();
    work = backend->work();
  }
};

/// Returns the time of a kernel in one frame and the size of its buffers, both summed over the kernel's
/// launches.
cl::KernelTime of_kernel(const cl::FrameTiming& timing, const std::string& kernel) {
  cl::KernelTime sum{kernel, "", 0, 0};
  for (const cl::KernelTime& k : timing.kernels) {
    if (k.kernel != kernel) continue;
    sum.ms += k.ms;
    sum.bytes += k.bytes;
  }
  return sum;
}

/// A counter whose rate Google Benchmark computes. `value` is its value in one iteration.
benchmark::Counter rate(double value) {
  return {value, benchmark::Counter::kIsIterationInvariantRate};
}

void time_kernel(benchmark::State& state, Bench& bench, const std::string& kernel) {
  std::size_t bytes = 0;
  for (auto unused : state) {
    const cl::KernelTime time = of_kernel(bench.backend->frame(), kernel);
    if (time.ms <= 0) {
      state.SkipWithError("the kernel's event has no time");
      break;
    }
    state.SetIterationTime(time.ms / 1000);
    bytes = time.bytes;
  }
  state.SetBytesProcessed(state.iterations() * std::int64_t(bytes));
  if (kernel.ends_with("_shells")) {
    state.counters["covered"] = rate(bench.work.covered);
    state.counters["shaded"] = rate(bench.work.shaded);
    state.counters["blended"] = rate(bench.work.blended);
  }
}

void time_mask(benchmark::State& state, Bench& bench) {
  std::size_t bytes = 0;
  for (auto unused : state) {
    const cl::Event event = bench.wet.run(bench.queue);
    bench.queue.finish();
    const auto ms = event.milliseconds(bench.queue.device());
    if (!ms) {
      state.SkipWithError("the kernel's event has no time");
      break;
    }
    state.SetIterationTime(*ms / 1000);
    bytes = event.bytes();
  }
  state.SetBytesProcessed(state.iterations() * std::int64_t(bytes));
  const double size = bench.input->scene.wetness.size;
  state.counters["texels"] = rate(size * size);
}

Scene scene_of(const Options& options) {
  Scene scene;
  if (!options.scene.empty()) scene = read_scene(options.scene);
  for (const std::string& assignment : options.set) apply_set(scene, assignment);
  check_scene(scene, options.scene.empty() ? "scene" : options.scene);
  return scene;
}

/// Registers one benchmark per kernel with a fixed number of iterations, which is computed from the time of a
/// pilot frame. Otherwise Google Benchmark would increase the number of iterations until the sum of the
/// reported times is long enough. If the device timer reports times of 0, Google Benchmark would never stop.
void register_all(Bench& bench, const Options& options, bool timer) {
  const cl::FrameTiming pilot = bench.backend->frame();
  const auto iterations = [&](double ms) {
    return std::clamp(std::int64_t(1000 * options.seconds / ms), std::int64_t(3), std::int64_t(10000));
  };
  const Scene& scene = bench.input->scene;
  const std::string where =
      fmt::format("{}/{}/{}x{}", scene.model, scene.fur.layers, scene.image.width, scene.image.height);
  const auto add = [&](const std::string& what, double ms, const auto& work) {
    benchmark::RegisterBenchmark(fmt::format("{}/{}", what, where).c_str(), work)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(iterations(ms));
  };
  add("frame", pilot.wall_ms, [&bench](benchmark::State& state) {
    for (auto unused : state) state.SetIterationTime(bench.backend->frame().wall_ms / 1000);
    state.counters["shaded"] = rate(bench.work.shaded);
  });
  if (!timer) return;
  if (bench.wet.program() != nullptr) {
    const cl::Event mask = bench.wet.run(bench.queue);
    bench.queue.finish();
    add("wetness_mask", std::max(0.1, mask.milliseconds(bench.queue.device()).value_or(0)),
        [&bench](benchmark::State& s) { time_mask(s, bench); });
  }
  std::set<std::string> known;
  for (const cl::KernelTime& k : pilot.kernels)
    if (known.insert(k.kernel).second)
      add(k.kernel, pilot.wall_ms,
          [&bench, kernel = k.kernel](benchmark::State& s) { time_kernel(s, bench, kernel); });
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("pelage's kernels on Google Benchmark; --benchmark_... options are passed on to it",
               "pelage-bench");
  app.allow_extras();
  app.add_option("--device", options.device, "PLATFORM:INDEX, or part of a device's name")
      ->type_name("DEVICE");
  app.add_option("scene", options.scene, "Scene file; without one, the default scene")
      ->type_name("SCENE.toml");
  app.add_option("--set", options.set, "Override one key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--mapping", options.mapping, mappings_help() + " (default: chosen for the device)")
      ->check(CLI::IsMember(mappings()))
      ->type_name("NAME");
  app.add_option("--seconds", options.seconds, "Time for each kernel's frames, s")
      ->check(CLI::Range(0.001, 3600.0))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{}; `pelage-bench --help` shows the usage", error.what()));
  }
  std::vector<std::string> words = app.remaining();
  std::vector<char*> rest{argv[0]};
  for (std::string& word : words) rest.push_back(word.data());
  rest.push_back(nullptr);
  int count = int(rest.size()) - 1;
  benchmark::Initialize(&count, rest.data());
  if (count > 1) throw InputError(fmt::format("{}: no such option, see pelage-bench --help", rest[1]));

  const Scene scene = scene_of(options);
  const cl::Device device = cl::choose_device(options.device);
  Bench bench(device, prepare(scene, load_scene_mesh(scene, {})), options.mapping);
  const cl::TimerCheck timer = cl::check_timer(bench.queue);
  if (!timer.real)
    fmt::print(stderr, "pelage-bench: {}: timing whole frames only, by the wall clock\n", timer.reason);
  benchmark::AddCustomContext("opencl_device", device.info().name);
  benchmark::AddCustomContext("opencl_platform", device.info().platform + ", driver " + device.info().driver);
  benchmark::AddCustomContext("pelage_revision", build_info().revision);
  benchmark::AddCustomContext("kernel_hash", cl::hash_of(bench.backend->programs()));
  benchmark::AddCustomContext("scene_hash", scene_hash(scene));
  register_all(bench, options, timer.real);
  return benchmark::RunSpecifiedBenchmarks() > 0 ? 0 : 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "pelage-bench: {}\n", error.what());
    if (dynamic_cast<const pelage::InputError*>(&error)) return 2;
    return dynamic_cast<const pelage::NoDeviceError*>(&error) ? 3 : 1;
  }
}
