#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage claims RESULTS... [--claims FILE] [--csv FILE|-] [--json|--markdown]: prints whether recorded
/// results support the claims of papers or of the user.
void add_claims(CLI::App& app, Chosen& chosen);

}  // namespace pelage
