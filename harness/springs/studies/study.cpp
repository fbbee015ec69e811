#include "harness/springs/studies/study.hpp"

#include <fmt/format.h>

#include "harness/error.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/springs/model/scene.hpp"
#include "harness/springs/studies/base.hpp"

namespace pelage::springs {
namespace {

Scene scene_with_springs(const SubjectContext& context, const Case& which) {
  Scene scene = scene_of(context.experiment, which);
  if (!has_springs(scene.dynamics))
    throw InputError(
        fmt::format("{}: dynamics.topology is {}; this experiment needs sticks, prisms, separable-sticks or "
                    "separable-prisms",
                    which.name, scene.dynamics.topology));
  return scene;
}

// Returns the scene's mass-spring system without an initial state.
Setting setting_of(SubjectContext& context, const Scene& scene) {
  SpringNetwork topology = topology_of(scene, *context.mesh_of(scene));
  const Dynamics dynamics = dynamics_of(scene.dynamics, topology);
  return {std::move(topology), dynamics, {}, 0};
}

Setting setting_of(SubjectContext& context, const Case& which) {
  return setting_of(context, scene_with_springs(context, which));
}

std::unique_ptr<Subject> solver_after_start(SubjectContext& context, const Case& which, bool baselines) {
  const Scene scene = scene_with_springs(context, which);
  Setting setting = setting_of(context, scene);
  setting.start = rest_motions(setting.topology);
  if (scene.dynamics.time > 0) {
    const cl::Queue queue(context.device);
    MassSprings before(queue, setting.topology, setting.dynamics);
    simulate(queue, before, setting.dynamics, double(scene.dynamics.time));
    setting.start = {before.offsets(queue), before.speeds(queue)};
    setting.steps = before.steps();
  }
  return solver_frames(context.device, std::move(setting), scene.dynamics.substeps, baselines);
}

// Returns the state of the scene after one second, computed with very short time steps. The result is stored
// and used again by other cases of the same scene.
const Motions& exact_of(SubjectContext& context, const Scene& scene, const Setting& setting) {
  // The exact solution does not depend on step, substeps, tolerance and solver.
  Scene any = scene;
  any.dynamics.step = 1;
  any.dynamics.substeps = 1;
  any.dynamics.tolerance = 0;
  any.dynamics.solver = highest_order.name;
  std::any& exact = context.shared["exact second of " + scene_hash(any)];
  if (!exact.has_value()) exact = exact_second(setting.topology, setting.dynamics, 1e-4f);
  return std::any_cast<const Motions&>(exact);
}

}  // namespace

std::unique_ptr<Subject> make_solver(SubjectContext& context, const Case& which) {
  return solver_after_start(context, which, false);
}
std::unique_ptr<Subject> make_solver_against_baselines(SubjectContext& context, const Case& which) {
  return solver_after_start(context, which, true);
}
std::unique_ptr<Subject> make_solver_limit(SubjectContext& context, const Case& which) {
  return solver_limit(context.device, setting_of(context, which));
}
std::unique_ptr<Subject> make_solver_energy(SubjectContext& context, const Case& which) {
  return solver_energy(context.device, setting_of(context, which), false);
}
std::unique_ptr<Subject> make_solver_drift(SubjectContext& context, const Case& which) {
  return solver_energy(context.device, setting_of(context, which), true);
}
std::unique_ptr<Subject> make_solver_shape(SubjectContext& context, const Case& which) {
  const Scene scene = scene_with_springs(context, which);
  return solver_shape(context.device, setting_of(context, scene), double(scene.dynamics.time));
}
std::unique_ptr<Subject> make_solver_error(SubjectContext& context, const Case& which) {
  const Scene scene = scene_with_springs(context, which);
  Setting setting = setting_of(context, scene);
  const Motions& exact = exact_of(context, scene, setting);
  return solver_error(context.device, std::move(setting), exact);
}
std::unique_ptr<Subject> make_solver_turns(SubjectContext& context, const Case& which) {
  const Scene scene = scene_with_springs(context, which);
  Setting setting = setting_of(context, scene);
  const Motions& exact = exact_of(context, scene, setting);
  return solver_turns(context.device, std::move(setting), exact, double(scene.dynamics.tolerance));
}
std::unique_ptr<Subject> make_solver_jacobian(SubjectContext& context, const Case& which) {
  const Scene scene = scene_with_springs(context, which);
  Setting setting = setting_of(context, scene);
  const Motions& exact = exact_of(context, scene, setting);
  return solver_jacobian(context.device, std::move(setting), exact);
}

}  // namespace pelage::springs
