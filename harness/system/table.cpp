// The table of all systems and, in the file that each of them names, of its backends.
#include "harness/system/system.hpp"

namespace pelage {

extern const System shells_system;   // harness/system/shells/system.cpp
extern const System strands_system;  // harness/system/strands/system.cpp

std::span<const System* const> systems() {
  static const System* const all[] = {&shells_system, &strands_system};
  return all;
}

KnownBackend backend_named(std::string_view name) {
  for (const System* system : systems())
    for (const BackendKind& kind : system->backends)
      if (kind.name == name) return {system, &kind};
  return {};
}

std::vector<Check> Backend::checks(const Picture& timed, std::uint32_t) {
  still();
  return {{"a second drawing", "largest difference", compare(timed, read()).worst, 0, false}};
}

double Backend::build_ms() const {
  double sum = 0;
  for (const cl::Program* program : programs()) sum += program->build_ms();
  return sum;
}

}  // namespace pelage
