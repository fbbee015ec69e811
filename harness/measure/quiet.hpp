// Looks before each case whether other processes use the machine (pelage run --quiet-machine).
#pragma once
#include <functional>
#include <optional>
#include <string>

namespace pelage {

/// `warn` prints a warning before a case that starts on a busy machine. `require` does not start this case.
enum class QuietMachine { unchecked, warn, require };

/// Returns the mode that the option names: "warn" or "require", "" for unchecked. Throws InputError for
/// another text.
QuietMachine quiet_machine_from_text(const std::string& text);

/// Measures for one second which share of the machine's CPU time other processes use (other_share()). Returns
/// nothing if the share is unknown.
std::optional<double> share_of_one_second();

/// The longest wait for a quiet machine, in calls of `share`: each call of share_of_one_second() takes one
/// second.
inline constexpr int most_waits = 60;

/// Returns an empty string if the machine is quiet: other processes use at most most_other_share
/// (harness/measure/cpu_use.hpp) of its CPU time, or the share is unknown. Otherwise returns a sentence with
/// the share. `require` calls `share` again until the machine is quiet, at most most_waits times.
std::string disturbance(QuietMachine mode, const std::function<std::optional<double>()>& share);

}  // namespace pelage
