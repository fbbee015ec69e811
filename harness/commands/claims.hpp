#pragma once
#include "harness/commands/command.hpp"

namespace pelage {

/// pelage claims RESULTS... [--claims FILE] [--csv FILE|-] [--json|--markdown]: judges claims of papers, or
/// of the user, by recorded results.
void add_claims(CLI::App& app, Chosen& chosen);

}  // namespace pelage
