#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "harness/commands/commands.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/compare/check_scenes.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/system/system.hpp"

namespace pelage {
namespace {

struct CheckOptions {
  std::vector<std::string> stages;
  std::string device, mapping, filter;
  bool full = false, hashes = false;
};

/// Prints one line: the name of the test case, the name of the hashed data, and the hash of its bytes.
void print_hash(const CheckScene& which, const std::string& what, const std::string& hash) {
  fmt::print("{:<34} {:<44} {}\n", which.name, what, hash);
}

const System& system_of(const CheckScene& which) {
  return *backend_named(which.scene.pipeline).system;
}

/// True if `mapping`, a value of --mapping, can draw the case.
bool draws(const std::string& mapping, const CheckScene& which, const cl::DeviceInfo& device) {
  const std::vector<std::string> names = system_of(which).mappings(device);
  return std::find(names.begin(), names.end(), mapping) != names.end();
}

std::vector<std::string> all_stages() {
  std::vector<std::string> stages;
  for (const System* system : systems())
    stages.insert(stages.end(), system->stages.begin(), system->stages.end());
  return stages;
}

/// Returns the cases whose names contain a match of the regular expression `filter`. Throws InputError if the
/// expression is malformed or no case matches.
std::vector<CheckScene> filtered(std::vector<CheckScene> cases, const std::string& filter) {
  const Filter pattern(filter);
  std::erase_if(cases, [&](const CheckScene& which) { return !pattern.finds(which.name); });
  if (cases.empty()) throw InputError(fmt::format("--filter {}: no case has a name that matches", filter));
  return cases;
}

int run_checks(const CheckOptions& options) {
  const std::vector<std::string> stages = options.stages.empty() ? all_stages() : options.stages;
  const auto chosen = [&stages](std::string_view stage) {
    return std::find(stages.begin(), stages.end(), stage) != stages.end();
  };
  std::vector<CheckScene> cases = filtered(check_scenes(options.full), options.filter);
  const cl::Device device = cl::choose_device(options.device);
  // With --mapping, the checks draw with this mapping only.
  if (!options.mapping.empty()) {
    offered_mapping(options.mapping, device.info());
    std::erase_if(cases,
                  [&](const CheckScene& which) { return !draws(options.mapping, which, device.info()); });
    if (options.stages == std::vector<std::string>{"mappings"})
      throw InputError("--mapping: the stage mappings compares all mappings; omit one of the two");
  }
  const auto request = [&](const CheckScene& which) {
    return CheckRequest{which.scene, load_scene_mesh(which.scene), device, options.mapping, which.motion,
                        chosen};
  };
  if (options.hashes) {
    for (const CheckScene& which : cases) {
      system_of(which).hash(request(which), [&](const std::string& what, const std::string& hash) {
        print_hash(which, what, hash);
      });
      std::fflush(stdout);
    }
    return 0;
  }
  // A case whose system has none of the chosen stages would simulate for nothing.
  std::erase_if(cases, [&](const CheckScene& which) {
    const auto own = system_of(which).stages;
    return std::none_of(own.begin(), own.end(), chosen);
  });
  fmt::print("{}\n{:<9} {:<26} {:<34} {:>10} {:>10}\n", device.info().name, "stage", "case", "metric",
             "value", "limit");
  std::size_t failures = 0, done = 0;
  for (const CheckScene& which : cases) {
    fmt::print(stderr, "{}/{} {}\n", ++done, cases.size(), which.name);
    for (const auto& [stage, check] : system_of(which).check(request(which))) {
      fmt::print("{:<9} {:<26} {:<34} {:>10.4g} {} {:>7.4g}  {}\n", stage, which.name, check.metric,
                 check.value, check.at_least ? ">=" : "<=", check.limit, check.holds() ? "ok" : "FAILED");
      failures += !check.holds();
    }
    std::fflush(stdout);
  }
  if (failures > 0) fmt::print(stderr, "pelage: {} checks failed\n", failures);
  return failures > 0 ? 1 : 0;
}

}  // namespace

void add_check(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<CheckOptions>(
      app, chosen, "check", "Compare the results of a device with the double-precision reference",
      run_checks);
  add_value(
      command, "stages", options.stages, "STAGE",
      "Stages to compare: simulate, mask, picture and mappings of shells, chains and strands of fur of single strands (default: all)")
      ->check(CLI::IsMember(all_stages()));
  add_device_option(command, options.device);
  add_mapping_option(
      command, options.mapping,
      "Draw with this mapping only (default: with every mapping that suits the device, its own default first)");
  add_value(command, "--filter", options.filter, "REGEX",
            "Use only the cases whose names match this regular expression, for instance torus");
  command.add_flag(
      "--full", options.full,
      "Compare a larger set of cases: all eight models, each with 16 and 64 layers of curly, wet fur in wind, and a mesh of 5 million triangles");
  command.add_flag(
      "--hashes", options.hashes,
      "Print hashes and compare nothing: hashes of the strands, mask and picture for every mapping of pixels to work-items, of the masses for every topology and solver, and of 100 frames of single strands for three numbers of chunks of the sorted list. Two revisions with equal hashes compute equal results");
}

}  // namespace pelage
