#include "harness/measure/interruptions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <ctime>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

namespace pelage {
namespace {

namespace fs = std::filesystem;

const fs::path cgroups = "/sys/fs/cgroup";
std::atomic<std::uint64_t> continued{0};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string own_groups() {
  return text_of("/proc/self/cgroup");
}

/// Returns the folders of the CPU's controller: that of the process's cgroup, and those of its parents. In a
/// container, the root is often that of the process's own cgroup, and the other folders do not exist.
std::vector<fs::path> folders_of(const fs::path& root, const std::string& groups) {
  std::vector<fs::path> folders;
  std::istringstream lines(groups);
  for (std::string line; std::getline(lines, line);) {
    // Version 2: "0::/path". Version 1: "4:cpu,cpuacct:/path".
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && ("," + controllers + ",").find(",cpu,") == std::string::npos) continue;
    const fs::path mounted = root / controllers;
    for (fs::path group = fs::path(line.substr(second + 1)).relative_path();; group = group.parent_path()) {
      folders.push_back(mounted / group);
      if (group.empty()) break;
    }
  }
  return folders;
}

std::optional<double> quota_of(const fs::path& folder) {
  std::istringstream words(text_of(folder / "cpu.max"));
  double quota = 0, period = 0;
  if (!(words >> quota >> period)) {  // "max 100000": no quota
    std::istringstream(text_of(folder / "cpu.cfs_quota_us")) >> quota;
    std::istringstream(text_of(folder / "cpu.cfs_period_us")) >> period;
  }
  if (quota > 0 && period > 0) return quota / period;
  return {};
}

double seconds_of(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

void count_stop(int) {
  continued.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

int usable_cores() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : int(sysconf(_SC_NPROCESSORS_ONLN));
}

std::optional<double> cpu_quota(const fs::path& root, const std::string& groups) {
  std::optional<double> least;
  for (const fs::path& folder : folders_of(root, groups))
    if (const auto quota = quota_of(folder)) least = std::min(*quota, least.value_or(*quota));
  return least;
}

std::optional<double> cpu_quota() {
  return cpu_quota(cgroups, own_groups());
}

std::uint64_t throttled_periods(const fs::path& root, const std::string& groups) {
  std::uint64_t sum = 0;
  for (const fs::path& folder : folders_of(root, groups)) {
    std::istringstream words(text_of(folder / "cpu.stat"));
    std::string name;
    for (std::uint64_t value = 0; words >> name >> value;)
      if (name == "nr_throttled") sum += value;
  }
  return sum;
}

Interruptions interruptions() {
  static const bool counting = [] {
    struct sigaction action = {};
    action.sa_handler = count_stop;  // a process that a signal stopped receives SIGCONT when it continues
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    return sigaction(SIGCONT, &action, nullptr) == 0;
  }();
  static_cast<void>(counting);
  return {throttled_periods(cgroups, own_groups()), continued.load(std::memory_order_relaxed),
          seconds_of(CLOCK_BOOTTIME) - seconds_of(CLOCK_MONOTONIC)};
}

void add_interruptions(Row& row, const Interruptions& before, const Interruptions& after) {
  if (after.throttled > before.throttled) row.provenance["throttled"] = after.throttled - before.throttled;
  if (after.stops > before.stops) row.provenance["stops"] = after.stops - before.stops;
  // The two clocks are read one after the other.
  if (after.suspended_s > before.suspended_s + 0.1)
    row.provenance["suspended_s"] = after.suspended_s - before.suspended_s;
}

std::string interruption_warning(const Row& row) {
  std::vector<std::string> texts;
  if (const auto count = provenance_number(row, "throttled"))
    texts.push_back(fmt::format("its cgroup's quota of CPU time was used up {:g} times", *count));
  if (const auto count = provenance_number(row, "stops"))
    texts.push_back(fmt::format("a signal stopped it {:g} times", *count));
  if (const auto seconds = provenance_number(row, "suspended_s"))
    texts.push_back(fmt::format("the machine slept for {:.1f} s", *seconds));
  if (texts.empty()) return {};
  return fmt::format("{}: while this case was timed, pelage could not run: {}", row.case_name,
                     fmt::join(texts, "; "));
}

}  // namespace pelage
