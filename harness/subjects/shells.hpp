// The shell pipeline as a subject of the harness.
#pragma once
#include <map>
#include <string>

#include "harness/cl/device.hpp"
#include "harness/measure/subject.hpp"
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Makes cases of `experiment` on `device`. Meshes stay in memory from case to case. `tuning` is passed on to
/// the kernels; `progress` is told what takes long.
MakeSubject shells_on(const cl::Device& device, const Experiment& experiment,
                      const std::map<std::string, int>& tuning,
                      const std::function<void(const std::string&)>& progress);

}  // namespace pelage
