// The events of one frame's launches by phase.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::shells {

/// (phase, event) in launch order; read once the queue has finished.
using PhaseEvents = std::vector<std::pair<std::string, cl::Event>>;

}  // namespace pelage::shells
