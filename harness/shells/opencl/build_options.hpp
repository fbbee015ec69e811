// Build options of the OpenCL kernels.
#pragma once
#include <map>
#include <string>

namespace pelage::shells {

/// Values of tuning axes (kernels/*/tuning.toml) by name. An axis that is absent keeps its default value.
using Tuning = std::map<std::string, int>;

/// Returns the value of `axis` in `tuning`, or `otherwise` if `tuning` does not contain the axis.
int tuned(const Tuning& tuning, const std::string& axis, int otherwise);

/// Returns the options of an OpenCL build: "-D LANES=lanes -D NAME=value ...".
std::string build_options(int lanes, const Tuning& tuning);

}  // namespace pelage::shells
