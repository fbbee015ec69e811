#include "harness/shells/opencl/build_options.hpp"

#include <fmt/format.h>

namespace pelage::shells {

std::string build_options(int lanes, const Tuning& tuning) {
  std::string options = fmt::format("-D LANES={}", lanes);
  for (const auto& [name, value] : tuning) options += fmt::format(" -D {}={}", name, value);
  return options;
}

int tuned(const Tuning& tuning, const std::string& axis, int otherwise) {
  const auto found = tuning.find(axis);
  return found == tuning.end() ? otherwise : found->second;
}

}  // namespace pelage::shells
