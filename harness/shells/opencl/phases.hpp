// The events of the kernel launches of one frame, with their phases.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::shells {

/// Pairs of phase and event, in launch order. Event times can be read only after the queue has finished.
using PhaseEvents = std::vector<std::pair<std::string, cl::Event>>;

}  // namespace pelage::shells
