#include "harness/subjects/pipelines.hpp"

#include <fmt/format.h>

#include "harness/springs/studies/study.hpp"
#include "harness/subjects/frames.hpp"
#include "harness/subjects/in_turns.hpp"
#include "harness/system/strands/backends.hpp"

namespace pelage {
namespace {

std::unique_ptr<Subject> frames_of(SubjectContext& context, const Case& which, std::string_view backend) {
  return std::make_unique<Frames>(context, which, backend_named(backend));
}

/// In every round, the device and OpenGL draw the same key strands, and neither time contains a simulation.
std::unique_ptr<Subject> strands_against_opengl(SubjectContext& context, const Case& which) {
  auto theirs = std::make_unique<Frames>(context, which, backend_named("strands-opengl"), true);
  auto ours = std::make_unique<Frames>(context, which, backend_named("strands"), true);
  strands::show_keys(theirs->backend(), strands::keys_of(ours->backend()));
  return with_opengl(std::move(ours), std::move(theirs));
}

/// The studies: what experiments time besides the backends of the systems.
constexpr Pipeline studies[] = {
    {"shells+fewer",
     [](SubjectContext& context, const Case& which) {
       return fewer_layers([&](const Case& fewer) { return frames_of(context, fewer, "shells"); }, which,
                           scene_of(context.experiment, which).fur.layers);
     }},
    {"shells+baseline",
     [](SubjectContext& context, const Case& which) {
       return against_control_scene([&](const Case& scene) { return frames_of(context, scene, "shells"); },
                                    context.experiment, which);
     }},
    {"shells+opengl",
     [](SubjectContext& context, const Case& which) {
       auto theirs = frames_of(context, which, "opengl");
       return with_opengl(frames_of(context, which, "shells"), std::move(theirs));
     }},
    {"shells-drawing",
     [](SubjectContext& context, const Case& which) -> std::unique_ptr<Subject> {
       return std::make_unique<Frames>(context, which, backend_named("shells"), true);
     }},
    {"strands+baseline",
     [](SubjectContext& context, const Case& which) {
       return against_control_scene([&](const Case& scene) { return frames_of(context, scene, "strands"); },
                                    context.experiment, which);
     }},
    {"strands+opengl", strands_against_opengl},
    {"strands+raycast",
     [](SubjectContext& context, const Case& which) {
       return against_raycast(context, which, frames_of(context, which, "strands"));
     }},
    {"shells+raycast",
     [](SubjectContext& context, const Case& which) {
       return against_raycast(context, which, frames_of(context, which, "shells"));
     }},
    {"springs", springs::make_solver},
    {"springs+baseline",
     [](SubjectContext& context, const Case& which) {
       return against_control_scene([&](const Case& scene) { return springs::make_solver(context, scene); },
                                    context.experiment, which);
     }},
    {"springs+rivals", springs::make_solver_against_baselines},
    {"springs-error", springs::make_solver_error},
    {"springs-limit", springs::make_solver_limit},
    {"springs-energy", springs::make_solver_energy},
    {"springs-drift", springs::make_solver_drift},
    {"springs-shape", springs::make_solver_shape},
    {"springs-turns", springs::make_solver_turns},
    {"springs-jacobian", springs::make_solver_jacobian},
};

}  // namespace

std::vector<std::string_view> pipelines() {
  std::vector<std::string_view> names;
  for (const System* system : systems())
    for (const BackendKind& kind : system->backends) names.push_back(kind.name);
  for (const Pipeline& study : studies) names.push_back(study.name);
  return names;
}

std::shared_ptr<SubjectContext> make_context(const cl::Device& device, const Experiment& experiment,
                                             const std::map<std::string, int>& tuning,
                                             const std::function<void(const std::string&)>& progress) {
  return std::make_shared<SubjectContext>(SubjectContext{device, experiment, tuning, progress, {}, {}});
}

MakeSubject subjects_of(std::shared_ptr<SubjectContext> context) {
  return [context = std::move(context)](const Case& which) -> std::unique_ptr<Subject> {
    if (backend_named(which.pipeline)) return frames_of(*context, which, which.pipeline);
    for (const Pipeline& study : studies)
      if (study.name == which.pipeline) return study.make(*context, which);
    throw Unsupported(fmt::format("this build has no pipeline '{}'", which.pipeline));
  };
}

}  // namespace pelage
