#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage roofline [EXPERIMENT]: where a frame's time goes, kernel by kernel, against the device's ceilings.
/// Exit 1 when a picture fails its check: that case is left out.
void add_roofline(CLI::App& app, Chosen& chosen);

}  // namespace pelage
