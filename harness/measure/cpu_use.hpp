// Measures the CPU time of this process during a frame, and the CPU time of all other processes while one
// case of an experiment is timed.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "harness/record/row.hpp"

namespace pelage {

/// Returns the CPU time that all threads of this process have used so far, in ms. Work on a GPU is not
/// included.
double process_cpu_ms();

/// Wall time of some work, and the CPU time of this process (process_cpu_ms()) for the same work, both in ms.
struct Cost {
  double wall_ms = 0, cpu_ms = 0;
};
Cost cost_of(const std::function<void()>& work);

/// Times of all CPUs together, counted from the start of the machine, in seconds. The first line of
/// /proc/stat contains these times.
struct MachineTime {
  double busy_s = 0;   ///< user code, system, interrupts, and time stolen by a hypervisor
  double total_s = 0;  ///< busy time plus idle time
};

/// Parses the first line of /proc/stat ("cpu  user nice system idle iowait irq softirq steal ..." in ticks).
/// `ticks` is the number of ticks per second. Returns nothing if the line has another format.
std::optional<MachineTime> machine_time(const std::string& line, double ticks);

/// Returns the share of CPU time that other processes used between `before` and `after`, as a fraction (0 to
/// 1) of the machine's CPU time in this interval. `own_s` is the CPU time of this process in the same
/// interval, in seconds. Returns nothing if the machine's counters did not change.
std::optional<double> other_share(MachineTime before, MachineTime after, double own_s);

/// Measures the CPU time of other processes since construction.
class CpuWatch {
 public:
  CpuWatch();
  /// Returns the share of CPU time that other processes have used since construction. Returns nothing if
  /// /proc/stat cannot be read. Also returns nothing during the first 0.2 s, because ticks of 10 ms are too
  /// coarse for such short times.
  std::optional<double> other_share() const;

 private:
  std::optional<MachineTime> machine_;
  double own_ms_;
};

/// The times in a row of results are doubtful if other processes used more than this share of the machine's
/// CPU time.
inline constexpr double most_other_share = 0.1;

/// Returns a warning of one line if other processes used more than most_other_share of the machine's CPU time
/// while the case of `row` was timed. Returns an empty string otherwise, or if the share is unknown.
std::string load_warning(const Row& row);

/// Returns the largest resident memory of this process in bytes (VmHWM of Linux) since its start or the last
/// reset. Returns 0 if it cannot be read.
std::uint64_t peak_memory();

/// Sets the peak resident memory of this process to its current resident memory. If Linux does not allow the
/// reset, the peak is unchanged. peak_memory() then returns an upper bound of the peak since this call.
void reset_peak_memory();

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
