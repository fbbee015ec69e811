// Build options of the OpenCL kernels. A tuning axis is a parameter of the kernels, or of their launches,
// that affects only the speed.
#pragma once
#include <map>
#include <string>

namespace pelage::shells {

/// Values of tuning axes by name. The files kernels/*/tuning.toml list the axes. An axis that is not in the
/// map keeps its default value.
using Tuning = std::map<std::string, int>;

/// Returns the value of `axis` in `tuning`, or `otherwise` if `tuning` does not contain the axis.
int tuned(const Tuning& tuning, const std::string& axis, int otherwise);

/// Returns the build options of an OpenCL program: "-D LANES=lanes", and one "-D NAME=value" per tuning axis.
/// The axes that no kernel of the program reads are left out when it is built (options_read(), harness/cl).
std::string build_options(int lanes, const Tuning& tuning);

}  // namespace pelage::shells
