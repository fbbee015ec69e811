// Options with which the kernels of a stage are built.
#pragma once
#include <map>
#include <string>

namespace pelage::shells {

/// Values of the kernels' tuning axes (kernels/*/tuning.toml); one that is absent has its shipped value.
using Tuning = std::map<std::string, int>;

/// The axis' value in `tuning`, else `otherwise`.
int tuned(const Tuning& tuning, const std::string& axis, int otherwise);

/// "-D LANES=n -D NAME=value ..." for a kernel build.
std::string build_options(int lanes, const Tuning& tuning);

}  // namespace pelage::shells
