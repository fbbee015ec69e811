// pelage list and pelage devices: the experiments with their presets and cases; the OpenCL platforms and
// devices.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "harness/cl/device.hpp"
#include "harness/cl/measure.hpp"
#include "harness/commands/commands.hpp"
#include "harness/commands/progress.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"

namespace pelage {
namespace {

using Json = nlohmann::ordered_json;

struct ListOptions {
  std::string experiment, preset = "quick";
  bool json = false;
};

/// Returns an upper limit of the time for sampling all cases of the preset, in seconds. The preparation of
/// meshes and textures and the checks of the pictures take additional time.
double most_seconds(const Experiment& experiment, const Preset& preset) {
  return double(cases_of(experiment, preset).size()) * (preset.limits.warm_up_s + preset.limits.limit_s);
}

/// Returns " (PAPER, TABLE)", the source of the experiment. Omits PAPER or TABLE if the experiment file
/// does not give it. Returns "" if the file gives neither of them.
std::string source_of(const Experiment& experiment) {
  if (experiment.paper.empty() && experiment.table.empty()) return "";
  const char* between = experiment.paper.empty() || experiment.table.empty() ? "" : ", ";
  return fmt::format(" ({}{}{})", experiment.paper, between, experiment.table);
}

int list_all(bool json) {
  Json list = Json::array();
  for (const auto& file : experiment_files()) {
    const Experiment e = read_experiment(file);
    Json presets = Json::object();
    if (!json)
      fmt::print("{}\n  {}{}{}\n", e.name, e.title, source_of(e),
                 e.collection.empty() ? "" : ", collection " + e.collection);
    for (const auto& [name, preset] : e.presets) {
      const std::size_t count = cases_of(e, preset).size();
      presets[name] = {{"cases", count},
                       {"least_samples", preset.limits.least},
                       {"most_samples", preset.limits.most},
                       {"sampling_at_most_s", most_seconds(e, preset)}};
      if (!json)
        fmt::print("  {:8} {:3} cases, {} to {} samples each, sampling takes at most {}\n", name, count,
                   preset.limits.least, preset.limits.most, clock_text(most_seconds(e, preset)));
    }
    list.push_back({{"name", e.name},
                    {"title", e.title},
                    {"paper", e.paper},
                    {"table", e.table},
                    {"collection", e.collection},
                    {"file", file.string()},
                    {"presets", presets}});
  }
  if (json) fmt::print("{}\n", list.dump(2));
  return 0;
}

std::string figure_text(const Metric& figure) {
  const std::string relation = figure.relation == "=" ? "" : figure.relation + " ";
  return fmt::format("{}{} {}", relation, figure.value, figure.unit);
}

int list_cases(const ListOptions& options) {
  const Experiment e = read_experiment(experiment_file(options.experiment));
  Json list = Json::array();
  for (const Case& c : cases_of(e, preset_of(e, options.preset))) {
    const std::string paper = c.published ? figure_text(*c.published) : "";
    if (options.json) {
      list.push_back({{"case", c.name}, {"variant", c.variant}, {"axes", c.axes}, {"paper", paper}});
    } else {
      fmt::print("{:36} {:14} {}\n", c.name, c.variant, paper.empty() ? "" : "paper: " + paper);
    }
  }
  if (options.json) fmt::print("{}\n", list.dump(2));
  return 0;
}

int list(const ListOptions& options) {
  return options.experiment.empty() ? list_all(options.json) : list_cases(options);
}

}  // namespace

void add_list(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<ListOptions>(
      app, chosen, "list", "List the experiments, or the cases of one experiment", list);
  add_value(command, "experiment", options.experiment, "EXPERIMENT|FILE.toml",
            "Experiment whose cases are listed: a name, or FILE.toml");
  add_value(command, "--preset", options.preset, "NAME", "Preset whose cases are listed");
  command.add_flag("--json", options.json, "Print JSON");
}

namespace {

struct DevicesOptions {
  bool measure = false, json = false;
};

double gib(std::uint64_t bytes) {
  return static_cast<double>(bytes) / (1 << 30);
}

nlohmann::ordered_json device_json(const cl::Device& device, const std::optional<cl::DeviceSpeed>& speed) {
  const cl::DeviceInfo& info = device.info();
  nlohmann::ordered_json json{{"device", info.spec()},
                              {"name", info.name},
                              {"vendor", info.vendor},
                              {"platform", info.platform},
                              {"platform_version", info.platform_version},
                              {"version", info.version},
                              {"c_version", info.c_version},
                              {"driver", info.driver},
                              {"gpu", info.gpu},
                              {"cpu", info.cpu},
                              {"compute_units", info.compute_units},
                              {"global_memory_bytes", info.global_memory},
                              {"local_memory_bytes", info.local_memory},
                              {"max_allocation_bytes", info.max_allocation},
                              {"max_work_group", info.max_work_group},
                              {"timer_resolution_ns", info.timer_resolution_ns},
                              {"fp64", info.fp64},
                              {"lanes", info.lanes}};
  if (speed)
    json["measured"] = {
        {"timer_real", speed->timer.real},         {"timer_reason", speed->timer.reason},
        {"timer_event_ms", speed->timer.event_ms}, {"timer_wall_ms", speed->timer.wall_ms},
        {"triad_gb_s", speed->triad_gb_s},         {"fma_gflop_s", speed->fma_gflop_s},
        {"launch_us", speed->launch_us},           {"queued_launch_us", speed->queued_launch_us}};
  return json;
}

void print_device(const cl::Device& device, const std::optional<cl::DeviceSpeed>& speed) {
  const cl::DeviceInfo& info = device.info();
  const char* kind = info.gpu && info.cpu ? "CPU and GPU"
                     : info.gpu           ? "GPU"
                     : info.cpu           ? "CPU"
                                          : "accelerator";
  fmt::print("{}  {}\n", info.spec(), info.name);
  fmt::print("     platform  {}, {}\n", info.platform, info.platform_version);
  fmt::print("     driver    {}, {}\n", info.driver, info.c_version);
  fmt::print("     device    {}, {} compute units, work-groups up to {}, {} per work-item{}\n", kind,
             info.compute_units, info.max_work_group,
             info.lanes == 1 ? "1 lane" : fmt::format("{} lanes", info.lanes), info.fp64 ? ", fp64" : "");
  fmt::print("     memory    {:.1f} GiB, at most {:.1f} GiB per buffer, {} KiB local\n",
             gib(info.global_memory), gib(info.max_allocation), info.local_memory >> 10);
  if (!speed) {
    fmt::print(
        "     timer     {}\n",
        info.timer_resolution_ns > 0
            ? fmt::format("resolution {} ns", info.timer_resolution_ns)
            : "no event timer: the driver reports a timer resolution of 0; only wall-clock times are usable");
    return;
  }
  fmt::print(
      "     timer     {}\n",
      speed->timer.real
          ? fmt::format(
                "resolution {} ns; in a test, event times ({:.1f} ms) and wall clock ({:.1f} ms) agree",
                info.timer_resolution_ns, speed->timer.event_ms, speed->timer.wall_ms)
          : fmt::format("unreliable, only wall-clock times are usable: {}", speed->timer.reason));
  fmt::print("     bandwidth {:.1f} GB/s (triad)\n", speed->triad_gb_s);
  fmt::print("     peak      {:.1f} GFLOP/s (fma, single precision)\n", speed->fma_gflop_s);
  fmt::print(
      "     launch    {:.1f} us for a single kernel, {:.1f} us per kernel if 200 are enqueued together\n",
      speed->launch_us, speed->queued_launch_us);
}

int list_devices(const DevicesOptions& options) {
  const std::vector<cl::Device> all = cl::devices();
  auto list = nlohmann::ordered_json::array();
  bool failed = false;
  for (const cl::Device& device : all) {
    std::optional<cl::DeviceSpeed> speed;
    // If one device fails, the others are still listed.
    std::string failure;
    if (options.measure) try {
        speed = cl::measure_device(device);
      } catch (const DeviceError& error) {
        failure = error.what();
        failed = true;
      }
    if (options.json) {
      list.push_back(device_json(device, speed));
      if (!failure.empty()) list.back()["error"] = failure;
    } else {
      print_device(device, speed);
      if (!failure.empty()) fmt::print("     failed    {}\n", failure);
    }
  }
  auto idle = nlohmann::ordered_json::array();
  for (const cl::PlatformInfo& platform : cl::platforms()) {
    if (platform.devices > 0) continue;
    idle.push_back({{"platform", platform.name}, {"version", platform.version}});
    if (!options.json) fmt::print("{}    {}: a platform without devices\n", platform.index, platform.name);
  }
  if (options.json)
    fmt::print("{}\n",
               nlohmann::ordered_json{{"devices", list}, {"platforms_without_devices", idle}}.dump(2));
  if (all.empty())
    cl::choose_device("");  // throws NoDeviceError, whose message names the packages to install
  return failed ? 1 : 0;
}

}  // namespace

void add_devices(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<DevicesOptions>(
      app, chosen, "devices", "List every OpenCL platform and device", list_devices);
  command.add_flag(
      "--measure", options.measure,
      "Measure the event timer, the memory bandwidth, the arithmetic peak and the cost of a launch (about 2 s per device)");
  command.add_flag("--json", options.json, "Print JSON");
}

}  // namespace pelage
