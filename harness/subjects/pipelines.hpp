// What an experiment can time.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "harness/measure/subject.hpp"

namespace pelage {

/// All of them, in the order of docs/code.md.
std::span<const Pipeline> pipelines();

/// Makes the cases of `experiment` on `device` by the pipelines that they name; another name throws
/// Unsupported. Meshes stay in memory from case to case. `tuning` goes to the kernels; `progress` is told
/// what takes long.
MakeSubject subjects_on(const cl::Device& device, const Experiment& experiment,
                        const std::map<std::string, int>& tuning,
                        const std::function<void(const std::string&)>& progress);

}  // namespace pelage
