// `pelage check` of shells: tips, wetness mask and picture against the reference, and all mappings against
// the first one.
#include <fmt/format.h>

#include "harness/compare/checks.hpp"
#include "harness/hash.hpp"
#include "harness/prepare/prepare.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/springs/opencl/mass_springs.hpp"
#include "harness/system/shells/backends.hpp"

namespace pelage::shells {
namespace {

constexpr int checked_frames = 30;  // number of simulated frames of 1/60 s each; the last one is drawn

FrameOutput draw(const CheckRequest& request, const std::string& mapping,
                 const std::shared_ptr<const FrameInput>& input) {
  Shells shells(request.device, input, {mapping, {}});
  shells.advance(checked_frames - 1);
  shells.frame();
  return {mapping, checked_frames, shells.tips(), {}, shells.mask(), shells.read()};
}

template <class T>
std::string hash_of(const std::vector<T>& values) {
  return Hash().values(values).hex();
}

/// Prints a hash of the simulated masses for every topology and solver. For the default solver it also prints
/// a hash of the picture.
void hash_springs(const CheckRequest& request, const std::string& mapping,
                  const std::function<void(const std::string&, const std::string&)>& print) {
  for (const springs::Kind kind : springs::kinds) {
    Scene scene = request.scene;
    scene.dynamics.topology = std::string(kind.name);
    FrameInput input = *prepare(scene, request.mesh, Deforming::followed);
    for (const springs::Solver solver : springs::solvers) {
      input.scene.dynamics.solver = std::string(solver.name);
      const std::string what = fmt::format("{}, {}", kind.name, solver.name);
      Shells shells(request.device, std::make_shared<FrameInput>(input), {mapping, {}});
      try {
        if (solver == springs::default_solver) {
          shells.frame();
          print(what + ", picture", hash_of(shells.read().pixel));
        } else {
          shells.advance(1);
        }
        print(what + ", masses", hash_of(shells.tips()));
      } catch (const springs::Diverged& error) {
        print(what, fmt::format("diverged at step {}", error.step));
      }
    }
  }
}

}  // namespace

std::vector<StageCheck> check(const CheckRequest& request) {
  const auto input = prepare(request.scene, request.mesh, Deforming::followed);
  const std::string first = offered_mapping(request.mapping, request.device.info());
  const FrameOutput drawn = draw(request, first, input);
  std::vector<StageCheck> all;
  const auto add = [&](const std::string& stage, const std::string& mapping,
                       const std::vector<Check>& checks) {
    for (Check check : checks) {
      if (!mapping.empty()) check.metric += fmt::format(", {}", mapping);
      all.push_back({stage, check});
    }
  };
  const bool picture = request.wants("picture"), others = request.wants("mappings");
  const FrameOutput reference =
      picture ? reference_output(*input, checked_frames, false) : reference_motion(*input, checked_frames);
  if (request.motion && request.wants("simulate")) {
    const Spread errors = tip_errors(double(request.scene.fur.length), drawn.tips, reference.tips);
    add("simulate", "", {check_worst_tip(errors), check_usual_tip(errors)});
  }
  // Without droplets the wetness masks of the device and of the reference are zero everywhere, so their
  // comparison would test nothing.
  if (request.motion && request.wants("mask") && !input->droplets.empty())
    add("mask", "", check_mask(drawn.mask, reference.mask));
  const auto add_picture = [&](const FrameOutput& output) {
    add("picture", output.pipeline,
        picture_checks(against_reference, compare(output.image, reference.image)));
  };
  if (picture) add_picture(drawn);
  if (!request.mapping.empty() || (!picture && !others)) return all;
  for (const std::string& name : mappings_on(request.device.info())) {
    if (name == first) continue;
    const FrameOutput other = draw(request, name, input);
    if (picture) add_picture(other);
    if (others) add("mappings", name, mapping_checks(first, drawn.image, other.image));
  }
  return all;
}

/// For every mapping of pixels to work-items, prints hashes of the strands' tips, the wetness mask and the
/// picture. Then calls hash_springs().
void hash(const CheckRequest& request,
          const std::function<void(const std::string&, const std::string&)>& print) {
  const auto input = prepare(request.scene, request.mesh, Deforming::followed);
  const std::vector<std::string> drawn =
      request.mapping.empty() ? mappings_on(request.device.info()) : std::vector{request.mapping};
  for (const std::string& mapping : drawn) {
    const FrameOutput output = draw(request, mapping, input);
    print(mapping + ", tips", hash_of(output.tips));
    print(mapping + ", mask", hash_of(output.mask));
    print(mapping + ", picture", hash_of(output.image.pixel));
  }
  hash_springs(request, drawn.front(), print);
}

}  // namespace pelage::shells
