// The pipelines that an experiment can time.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns the names of all pipelines: the backends of the systems (harness/system/table.cpp), and the
/// studies.
std::vector<std::string_view> pipelines();

/// Returns the data from which the subjects of a run are made. The context calls `progress` with a text at
/// each long preparation step.
std::shared_ptr<SubjectContext> make_context(const cl::Device& device, const Experiment& experiment,
                                             const std::map<std::string, int>& tuning,
                                             const std::function<void(const std::string&)>& progress);

/// Returns a factory of subjects that run the pipeline of their case. It throws Unsupported for an unknown
/// pipeline, and keeps the meshes that it loads in memory for later cases.
MakeSubject subjects_of(std::shared_ptr<SubjectContext> context);

}  // namespace pelage
