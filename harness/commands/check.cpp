#include <fmt/format.h>

#include <cstdio>
#include <set>

#include "harness/commands/commands.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/compare/check_scenes.hpp"
#include "harness/compare/frame_output.hpp"
#include "harness/compare/masks.hpp"
#include "harness/compare/pictures.hpp"
#include "harness/compare/strands.hpp"
#include "harness/compare/tips.hpp"
#include "harness/error.hpp"
#include "harness/experiment/filter.hpp"
#include "harness/hash.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/strands/opencl/strands.hpp"

namespace pelage {
namespace {

constexpr int frames = 30;          // number of simulated frames of 1/60 s each; the last one is drawn
constexpr int hashed_frames = 100;  // number of frames of strands in one hash

struct CheckOptions {
  std::vector<std::string> stages;
  std::string device, filter;
  bool full = false, hashes = false;
};

/// The result of one comparison with the reference, and the name of the compared stage.
struct StageCheck {
  std::string stage;
  Check check;
};

FrameOutput draw(const cl::Device& device, std::shared_ptr<const FrameInput> input,
                 const std::string& mapping) {
  ShellOptions options;
  options.mapping = mapping;
  Shells shells(device, std::move(input), options);
  shells.advance(frames - 1);
  shells.frame();
  return {mapping, frames, shells.tips(), {}, shells.mask(), shells.read()};
}

/// Compares a time step of the chains (stage "chains") and a picture (stage "strands").
std::vector<StageCheck> check_strands(const cl::Device& device, const CheckScene& which,
                                      const std::set<std::string>& stages) {
  std::vector<StageCheck> all;
  if (!stages.contains("chains") && !stages.contains("strands")) return all;
  const auto input = strands::prepare_strands(which.scene, load_scene_mesh(which.scene));
  strands::Strands strands(device, input);
  strands.advance(frames - 1);
  strands.frame();
  StrandFrame frame{strands.keys(), {}, strands.order(), strands.read()};
  frame.curves = strands.curves();
  frame.skin = strands.surface();
  if (stages.contains("strands"))
    for (const Check& check : check_strand_frame(*input, frame, 1).checks) all.push_back({"strands", check});
  if (stages.contains("chains")) {
    ChainStep step{strands.states(), {}, 0};
    step.number = strands.substep();
    step.after = strands.states();
    step.skin = strands.skin_frames();
    for (const Check& check : check_chain_step(*input, step, 1)) all.push_back({"chains", check});
  }
  return all;
}

std::vector<StageCheck> check_scene(const cl::Device& device, const CheckScene& which,
                                    const std::set<std::string>& stages) {
  if (which.strands) return check_strands(device, which, stages);
  const auto input = prepare(which.scene, load_scene_mesh(which.scene));
  const std::string& first = mappings().front();
  const FrameOutput drawn = draw(device, input, first);
  std::vector<StageCheck> all;
  const auto add = [&](const std::string& stage, const std::string& mapping,
                       const std::vector<Check>& checks) {
    for (Check check : checks) {
      if (!mapping.empty()) check.metric += fmt::format(", {}", mapping);
      all.push_back({stage, check});
    }
  };
  const bool picture = stages.contains("picture"), others = stages.contains("mappings");
  const FrameOutput reference =
      picture ? reference_output(*input, frames, false) : reference_motion(*input, frames);
  if (which.motion && stages.contains("simulate")) {
    const TipErrors errors = tip_errors(double(which.scene.fur.length), drawn.tips, reference.tips);
    add("simulate", "", {check_worst_tip(errors), check_usual_tip(errors)});
  }
  // Without droplets the wetness masks of the device and of the reference are zero everywhere, so their
  // comparison would test nothing.
  if (which.motion && stages.contains("mask") && !input->droplets.empty())
    add("mask", "", check_mask(drawn.mask, reference.mask));
  const auto add_picture = [&](const FrameOutput& output) {
    add("picture", output.pipeline,
        picture_checks(against_reference, compare(output.image, reference.image)));
  };
  if (picture) add_picture(drawn);
  if (!picture && !others) return all;
  for (const std::string& mapping : mappings()) {
    if (mapping == first) continue;
    const FrameOutput other = draw(device, input, mapping);
    if (picture) add_picture(other);
    if (others) add("mappings", mapping, mapping_checks(first, drawn.image, other.image));
  }
  return all;
}

/// Prints one line: the name of the test case, the name of the hashed data, and the hash of its bytes.
void print_hash(const CheckScene& which, const std::string& what, const std::string& hash) {
  fmt::print("{:<34} {:<44} {}\n", which.name, what, hash);
}

template <class T>
std::string hash_of(const std::vector<T>& values) {
  return Hash().values(values).hex();
}

/// Prints a hash of the simulated masses for every topology and solver. For the default solver it also prints
/// a hash of the picture.
void print_spring_hashes(const cl::Device& device, const CheckScene& which) {
  const auto mesh = load_scene_mesh(which.scene);
  for (const springs::Kind kind : springs::kinds) {
    Scene scene = which.scene;
    scene.dynamics.topology = std::string(kind.name);
    FrameInput input = *prepare(scene, mesh);
    for (const springs::Solver solver : springs::solvers) {
      input.scene.dynamics.solver = std::string(solver.name);
      const std::string what = fmt::format("{}, {}", springs::name(kind), springs::name(solver));
      ShellOptions options;
      options.mapping = mappings().front();
      Shells shells(device, std::make_shared<FrameInput>(input), options);
      try {
        if (solver == springs::default_solver) {
          shells.frame();
          print_hash(which, what + ", picture", hash_of(shells.read().pixel));
        } else {
          shells.advance(1);
        }
        print_hash(which, what + ", masses", hash_of(shells.tips()));
      } catch (const springs::Diverged& error) {
        print_hash(which, what, fmt::format("diverged at step {}", error.step));
      }
    }
  }
}

/// For each of three numbers of chunks, prints a hash of the key strands, the list of strands and the picture
/// of every frame of `hashed_frames` frames. All three hashes must be equal.
void print_strand_hashes(const cl::Device& device, const CheckScene& which) {
  const auto input = strands::prepare_strands(which.scene, load_scene_mesh(which.scene));
  for (const int chunks : {1, 16, 1024}) {
    strands::DrawerOptions options;
    options.chunks = chunks;
    strands::Strands strands(device, input, options);
    Hash hash;
    for (int frame = 0; frame < hashed_frames; ++frame) {
      strands.frame();
      hash.values(strands.keys()).values(strands.order()).values(strands.read().pixel);
    }
    print_hash(which, fmt::format("{} frames of strands, {} chunks", hashed_frames, chunks), hash.hex());
  }
}

/// For every mapping of pixels to work-items, prints hashes of the strands' tips, the wetness mask and the
/// picture. Then calls print_spring_hashes().
void print_hashes(const cl::Device& device, const CheckScene& which) {
  const auto input = prepare(which.scene, load_scene_mesh(which.scene));
  for (const std::string& mapping : mappings()) {
    const FrameOutput output = draw(device, input, mapping);
    print_hash(which, mapping + ", tips", hash_of(output.tips));
    print_hash(which, mapping + ", mask", hash_of(output.mask));
    print_hash(which, mapping + ", picture", hash_of(output.image.pixel));
  }
  print_spring_hashes(device, which);
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
  std::set<std::string> stages(options.stages.begin(), options.stages.end());
  if (stages.empty()) stages = {"simulate", "mask", "picture", "mappings", "chains", "strands"};
  std::vector<CheckScene> cases = filtered(check_scenes(options.full), options.filter);
  const cl::Device device = cl::choose_device(options.device);
  if (options.hashes) {
    for (const CheckScene& which : cases) {
      if (which.strands)
        print_strand_hashes(device, which);
      else
        print_hashes(device, which);
      std::fflush(stdout);
    }
    return 0;
  }
  fmt::print("{}\n{:<9} {:<26} {:<34} {:>10} {:>10}\n", device.info().name, "stage", "case", "metric",
             "value", "limit");
  std::size_t failures = 0, done = 0;
  for (const CheckScene& which : cases) {
    fmt::print(stderr, "{}/{} {}\n", ++done, cases.size(), which.name);
    for (const auto& [stage, check] : check_scene(device, which, stages)) {
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
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      app.add_subcommand("check", "Compare the results of a device with the double-precision reference");
  command
      ->add_option(
          "stages", options->stages,
          "Stages to compare: simulate, mask, picture and mappings of shells, chains and strands of fur of "
          "single strands (default: all)")
      ->check(CLI::IsMember({"simulate", "mask", "picture", "mappings", "chains", "strands"}))
      ->type_name("STAGE");
  command->add_option("--device", options->device, "Device to use: PLATFORM:INDEX, or part of its name")
      ->type_name("DEVICE");
  command
      ->add_option("--filter", options->filter,
                   "Use only the cases whose names match this regular expression, for instance torus")
      ->type_name("REGEX");
  command->add_flag(
      "--full", options->full,
      "Compare a larger set of cases: all eight models, each with 16 and 64 layers of curly, wet fur "
      "in wind, and a mesh of 5 million triangles");
  command->add_flag(
      "--hashes", options->hashes,
      "Print hashes and compare nothing: hashes of the strands, mask and picture for every mapping of pixels "
      "to work-items, of the masses for every topology and solver, and of 100 frames of single strands for "
      "three "
      "numbers of chunks of the sorted list. Two revisions with equal hashes compute equal results");
  command->callback([options, &chosen] { chosen = [options] { return run_checks(*options); }; });
}

}  // namespace pelage
