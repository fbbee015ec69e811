// What keeps this process from its cores: the cores it may use, the quota of its cgroup, signals that stop
// it, and a machine that sleeps.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "harness/record/row.hpp"

namespace pelage {

/// Returns the number of cores that this process may run on (sched_getaffinity).
int usable_cores();

/// The cgroups of a process limit its CPU time. `groups` is the text of /proc/self/cgroup, and `root` the
/// folder in which cgroups are mounted (/sys/fs/cgroup); versions 1 and 2 are read.
/// Returns the smallest quota of the process's cgroup and its parents, in cores; nothing without a quota.
std::optional<double> cpu_quota(const std::filesystem::path& root, const std::string& groups);
std::optional<double> cpu_quota();  ///< of this process

/// Counters that grow when this process cannot run.
struct Interruptions {
  std::uint64_t throttled = 0;  ///< periods in which a cgroup had used up its quota (nr_throttled)
  std::uint64_t stops = 0;      ///< stops of the process by a signal; the first call starts to count
  double suspended_s = 0;       ///< time since the machine's start in which it slept
};
Interruptions interruptions();

/// Returns the number of throttled periods of the process's cgroup and its parents.
std::uint64_t throttled_periods(const std::filesystem::path& root, const std::string& groups);

/// Writes what grew between `before` and `after` into the row's provenance: `throttled`, `stops` and
/// `suspended_s`.
void add_interruptions(Row& row, const Interruptions& before, const Interruptions& after);

/// Returns a warning of one line if the process was throttled, stopped or suspended while the row was timed;
/// "" if not.
std::string interruption_warning(const Row& row);

}  // namespace pelage
