// The OpenCL events of the kernel launches of one frame, and the phases to which the launches belong.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// One pair per kernel launch, in launch order: the name of the phase, for instance "simulate" or "raster",
/// and the event of the launch. Event times can be read only after the queue has finished.
using PhaseEvents = std::vector<std::pair<std::string, Event>>;

/// Appends a launch of the phase to `events`, unless `events` is null.
inline void keep(PhaseEvents* events, const char* phase, Event event) {
  if (events) events->emplace_back(phase, std::move(event));
}

}  // namespace pelage::cl
