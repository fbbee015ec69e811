// CPU time: of this process over a frame, and of all other processes over a case.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "harness/journal/row.hpp"

namespace pelage {

/// CPU time that all threads of this process have used so far, ms; what a GPU does is not in it.
double process_cpu_ms();

/// Wall time and process_cpu_ms() of the same stretch of work, ms.
struct Cost {
  double wall_ms = 0, cpu_ms = 0;
};
Cost cost_of(const std::function<void()>& work);

/// What all CPUs of the machine have done since it started, s: /proc/stat's first line.
struct MachineTime {
  double busy_s = 0;   ///< user, system, interrupts, and what a hypervisor took away
  double total_s = 0;  ///< and idle
};

/// Of such a line ("cpu  user nice system idle iowait irq softirq steal ..." in ticks), `ticks` to the
/// second; empty when it is no such line.
std::optional<MachineTime> machine_time(const std::string& line, double ticks);

/// The share (0 to 1) of the machine's CPU time between `before` and `after` that other processes took, when
/// this one took `own_s`; empty where the machine's counters did not move.
std::optional<double> other_share(MachineTime before, MachineTime after, double own_s);

/// Counts from its making on.
class CpuWatch {
 public:
  CpuWatch();
  /// other_share() since then; empty within 0.2 s, for which ticks of 10 ms are too coarse, and where
  /// /proc/stat cannot be read.
  std::optional<double> other_share() const;

 private:
  std::optional<MachineTime> machine_;
  double own_ms_;
};

inline constexpr double most_other_share = 0.1;  ///< above it a row's times are doubtful

/// One line about what other processes took during this row's samples; empty up to most_other_share and where
/// it is not known.
std::string load_warning(const Row& row);

}  // namespace pelage
