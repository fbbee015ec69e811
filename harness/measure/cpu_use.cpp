#include "harness/measure/cpu_use.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string_view>
#include <thread>

#include "harness/error.hpp"

namespace pelage {
namespace {

/// Returns the times up to now, with the busy time of other processes only. The total is 0 if unknown.
MachineTime others_now() {
  std::ifstream stream("/proc/stat");
  std::string line;
  std::getline(stream, line);
  MachineTime time = machine_time(line, double(sysconf(_SC_CLK_TCK))).value_or(MachineTime{});
  time.busy_s -= 1e-3 * process_cpu_ms();
  return time;
}

}  // namespace

double process_cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

Cost cost_of(const std::function<void()>& work) {
  const double cpu = process_cpu_ms();
  const auto from = std::chrono::steady_clock::now();
  work();
  const auto to = std::chrono::steady_clock::now();
  return {std::chrono::duration<double, std::milli>(to - from).count(), process_cpu_ms() - cpu};
}

std::optional<MachineTime> machine_time(const std::string& line, double ticks) {
  std::istringstream words(line);
  std::string name;
  double user, nice, system, idle, iowait = 0, irq = 0, softirq = 0, steal = 0;
  if (!(words >> name >> user >> nice >> system >> idle) || name != "cpu") return {};
  // Old kernels end the line here. The fields after steal hold guest time, which user and nice include.
  words >> iowait >> irq >> softirq >> steal;
  const double busy = user + nice + system + irq + softirq + steal;
  return MachineTime{busy / ticks, (busy + idle + iowait) / ticks};
}

std::optional<double> other_share(MachineTime before, MachineTime after) {
  const double total = after.total_s - before.total_s;
  if (!(total > 0)) return {};
  return std::clamp((after.busy_s - before.busy_s) / total, 0.0, 1.0);
}

CpuWatch::CpuWatch() : start_(others_now()) {}

std::optional<double> CpuWatch::other_share() const {
  const MachineTime now = others_now();
  const double cpus = double(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
  if (!(start_.total_s > 0) || now.total_s - start_.total_s < 0.2 * cpus) return {};
  return pelage::other_share(start_, now);
}

std::string load_warning(const Row& row) {
  const auto share = row.provenance.find("other_cpu_share");
  if (share == row.provenance.end() || share->get<double>() <= most_other_share) return {};
  return fmt::format("{}: other processes took {:.0f}% of the machine's CPU time while this case was timed",
                     row.case_name, 100 * share->get<double>());
}

std::uint64_t peak_memory() {
  constexpr std::string_view name = "VmHWM:";
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name)) return std::stoull(line.substr(name.size())) * 1024;
  return 0;
}

void reset_peak_memory() {
  malloc_trim(0);  // returns memory freed by earlier cases to the system
  std::ofstream("/proc/self/clear_refs") << 5 << std::flush;
}

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
