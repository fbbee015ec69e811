#include "harness/measure/quiet.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "harness/error.hpp"
#include "harness/measure/cpu_use.hpp"

namespace pelage {

QuietMachine quiet_machine_from_text(const std::string& text) {
  if (text.empty()) return QuietMachine::unchecked;
  if (text == "warn") return QuietMachine::warn;
  if (text == "require") return QuietMachine::require;
  throw InputError(fmt::format("--quiet-machine '{}' is neither warn nor require", text));
}

std::optional<double> share_of_one_second() {
  const CpuWatch watch;
  std::this_thread::sleep_for(std::chrono::seconds(1));
  return watch.other_share();
}

std::string disturbance(QuietMachine mode, const std::function<std::optional<double>()>& share) {
  if (mode == QuietMachine::unchecked) return {};
  std::optional<double> found = share();
  const auto busy = [&] { return found && *found > most_other_share; };
  for (int i = 1; mode == QuietMachine::require && busy() && i < most_waits; ++i) found = share();
  if (!busy()) return {};
  return fmt::format("other processes use {:.0f}% of the machine's CPU time", 100 * *found);
}

}  // namespace pelage
