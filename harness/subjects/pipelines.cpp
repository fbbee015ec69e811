#include "harness/subjects/pipelines.hpp"

#include <fmt/format.h>

#include "harness/springs/studies/study.hpp"
#include "harness/subjects/baseline_scene.hpp"
#include "harness/subjects/fewer_layers.hpp"
#include "harness/subjects/opengl.hpp"
#include "harness/subjects/raycast_difference.hpp"
#include "harness/subjects/shells.hpp"
#include "harness/subjects/strands.hpp"
#include "harness/subjects/with_opengl.hpp"

namespace pelage {
namespace {

constexpr Pipeline table[] = {
    {"shells", make_shells},
    {"shells+fewer",
     [](SubjectContext& context, const Case& which) {
       return fewer_layers([&](const Case& fewer) { return make_shells(context, fewer); }, which,
                           scene_of(context.experiment, which).fur.layers);
     }},
    {baseline_pipeline,
     [](SubjectContext& context, const Case& which) {
       return against_baseline_scene([&](const Case& scene) { return make_shells(context, scene); },
                                     context.experiment, which);
     }},
    {"opengl", make_opengl},
    {"shells+opengl",
     [](SubjectContext& context, const Case& which) {
       need_opengl();
       return with_opengl(make_shells(context, which), make_opengl(context, which));
     }},
    {"strands", make_strand_frames},
    {"strands+opengl", make_strands_against_opengl},
    {"strands+raycast",
     [](SubjectContext& context, const Case& which) {
       return against_raycast(context, which, make_strand_frames(context, which));
     }},
    {"shells+raycast",
     [](SubjectContext& context, const Case& which) {
       return against_raycast(context, which, make_shells(context, which));
     }},
    {"springs", springs::make_solver},
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

std::span<const Pipeline> pipelines() {
  return table;
}

std::shared_ptr<SubjectContext> make_context(const cl::Device& device, const Experiment& experiment,
                                             const std::map<std::string, int>& tuning,
                                             const std::function<void(const std::string&)>& progress) {
  return std::make_shared<SubjectContext>(SubjectContext{device, experiment, tuning, progress, {}, {}});
}

MakeSubject subjects_of(std::shared_ptr<SubjectContext> context) {
  return [context = std::move(context)](const Case& which) {
    for (const Pipeline& pipeline : pipelines())
      if (pipeline.name == which.pipeline) return pipeline.make(*context, which);
    throw Unsupported(fmt::format("this build has no pipeline '{}'", which.pipeline));
  };
}

}  // namespace pelage
