// Tests before each case whether other processes use the machine (option --quiet-machine of pelage run).
#pragma once
#include <functional>
#include <optional>
#include <string>

namespace pelage {

/// If the machine is busy when a case would start, `warn` prints a warning, and `require` does not start the
/// case. `unchecked` does not test the machine.
enum class QuietMachine { unchecked, warn, require };

/// Returns the mode for the text "warn" or "require"; "" stands for `unchecked`. Throws InputError for other
/// texts.
QuietMachine quiet_machine_from_text(const std::string& text);

/// Measures for one second, and returns the share of the machine's CPU time that other processes used, from 0
/// to 1. Returns no value if the share is unknown.
std::optional<double> share_of_one_second();

/// Largest number of measurements that `require` makes while it waits for a quiet machine. Each measurement
/// with share_of_one_second() takes one second.
inline constexpr int most_waits = 60;

/// Calls `share` to measure the share of CPU time of other processes. Returns a text with this share if it is
/// above most_other_share (harness/measure/cpu_use.hpp). Returns "" if the share is smaller or unknown, or if
/// `mode` is `unchecked`. If the mode is `require`, the function calls `share` up to most_waits times until
/// the machine is quiet.
std::string disturbance(QuietMachine mode, const std::function<std::optional<double>()>& share);

}  // namespace pelage
