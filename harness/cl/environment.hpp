#pragma once
#include <cstdlib>
#include <string>

namespace pelage::cl {

/// Returns the value of an environment variable; "" if it is not set.
inline std::string environment(const char* variable) {
  const char* value = std::getenv(variable);
  return value ? value : "";
}

}  // namespace pelage::cl
