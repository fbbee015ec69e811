// The pipelines that an experiment can time.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns the table of all pipelines. Each entry has a name and a factory function.
std::span<const Pipeline> pipelines();

/// Returns a factory of subjects (objects that the harness times) on `device`. For a case of `experiment` it
/// makes a subject that runs the case's pipeline. The factory throws Unsupported for an unknown pipeline, and
/// keeps meshes in memory for later cases. `tuning` maps the kernels' tuning axes to values. The factory
/// reports long preparation steps to `progress`.
MakeSubject subjects_on(const cl::Device& device, const Experiment& experiment,
                        const std::map<std::string, int>& tuning,
                        const std::function<void(const std::string&)>& progress);

}  // namespace pelage
