// Parts of the identity of a row that say which programs ran: pelage itself and its OpenCL programs.
#pragma once
#include <string>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/record/identity.hpp"

namespace pelage {

/// Adds one part per program: the hash of the program's source files at the time when the program was built.
void add_programs(Identity& identity, const std::vector<const cl::Program*>& programs);

/// Returns the hash of the compiler and the flags with which pelage was built. They influence the host's time
/// per frame and the times of the C++ baselines.
std::string build_hash();

}  // namespace pelage
