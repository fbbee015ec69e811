// Measures the CPU time and the memory of this process, and the CPU time of all other processes, also before
// each case starts (option --quiet-machine of pelage run).
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "harness/record/row.hpp"

namespace pelage {

/// Returns the CPU time that all threads of this process have used so far, in ms, without work on a GPU.
double process_cpu_ms();

/// Wall time and CPU time of this process for the same work, in ms.
struct Cost {
  double wall_ms, cpu_ms;
};
Cost cost_of(const std::function<void()>& work);

/// Times of all CPUs together since the start of the machine, in seconds, from the first line of /proc/stat.
struct MachineTime {
  double busy_s;   ///< user code, system, interrupts, and time stolen by a hypervisor
  double total_s;  ///< busy time plus idle time
};

/// Parses the first line of /proc/stat ("cpu  user nice system idle iowait irq softirq steal ..."), with
/// `ticks` per second. Returns nothing if the line has another format.
std::optional<MachineTime> machine_time(const std::string& line, double ticks);

/// Returns the share (0 to 1) of the machine's CPU time that other processes used between `before` and
/// `after`, whose busy times lack that of this process. Returns nothing if the counters did not change.
std::optional<double> other_share(MachineTime before, MachineTime after);

/// Measures the CPU time of other processes since construction.
class CpuWatch {
 public:
  CpuWatch();
  /// Returns the share of CPU time that other processes have used since construction. Returns nothing if
  /// /proc/stat cannot be read, or during the first 0.2 s, because ticks of 10 ms are too coarse for such
  /// short times.
  std::optional<double> other_share() const;

 private:
  MachineTime start_;
};

/// The times in a row are doubtful if other processes used more than this share of the CPU time.
inline constexpr double most_other_share = 0.1;

/// Returns a warning of one line if other processes used more than most_other_share while the row was timed;
/// "" if not, or if the share is unknown.
std::string load_warning(const Row& row);

/// Returns the largest resident memory of this process in bytes (VmHWM of Linux) since its start or the last
/// reset; 0 if it cannot be read.
std::uint64_t peak_memory();

/// Sets the peak to the current resident memory. If Linux does not allow the reset, peak_memory() then
/// returns an upper bound of the peak since this call.
void reset_peak_memory();

/// What happens if the machine is busy when a case would start: `warn` prints a warning, `require` does not
/// start the case, and `unchecked` does not test the machine.
enum class QuietMachine { unchecked, warn, require };

/// Returns the mode for the text "warn", "require" or "". Throws InputError for other texts.
QuietMachine quiet_machine_from_text(const std::string& text);

/// Returns the share of CPU time that other processes used within one second; nothing if it is unknown.
std::optional<double> share_of_one_second();

/// Largest number of measurements of `share` that `require` makes while it waits for a quiet machine.
inline constexpr int most_waits = 60;

/// Returns a text with the share of CPU time of other processes if it is above most_other_share; "" if it is
/// smaller or unknown, or if `mode` is `unchecked`. If the mode is `require`, the function calls `share` up
/// to most_waits times until the machine is quiet.
std::string disturbance(QuietMachine mode, const std::function<std::optional<double>()>& share);

}  // namespace pelage
