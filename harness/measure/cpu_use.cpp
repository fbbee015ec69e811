#include "harness/measure/cpu_use.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <numeric>
#include <sstream>
#include <thread>
#include <vector>

#include "harness/error.hpp"

namespace pelage {
namespace {

std::optional<MachineTime> machine_now() {
  std::ifstream stream("/proc/stat");
  std::string line;
  std::getline(stream, line);
  return machine_time(line, double(sysconf(_SC_CLK_TCK)));
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
  words >> name;
  // The fields are user, nice, system, idle, iowait, irq, softirq and steal. The fields after steal hold
  // guest time, which the fields user and nice already include.
  std::vector<double> field;
  for (double value = 0; field.size() < 8 && words >> value;) field.push_back(value / ticks);
  if (name != "cpu" || field.size() < 4) return {};
  const double total = std::accumulate(field.begin(), field.end(), 0.0);
  const double idle = field[3] + (field.size() > 4 ? field[4] : 0);
  return MachineTime{total - idle, total};
}

std::optional<double> other_share(MachineTime before, MachineTime after, double own_s) {
  const double total = after.total_s - before.total_s;
  if (!(total > 0)) return {};
  return std::clamp((after.busy_s - before.busy_s - own_s) / total, 0.0, 1.0);
}

CpuWatch::CpuWatch() : machine_(machine_now()), own_ms_(process_cpu_ms()) {}

std::optional<double> CpuWatch::other_share() const {
  const std::optional<MachineTime> now = machine_now();
  if (!machine_ || !now) return {};
  const double cpus = double(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
  if (now->total_s - machine_->total_s < 0.2 * cpus) return {};
  return pelage::other_share(*machine_, *now, (process_cpu_ms() - own_ms_) / 1000);
}

std::string load_warning(const Row& row) {
  const auto share = row.provenance.find("other_cpu_share");
  if (share == row.provenance.end() || share->get<double>() <= most_other_share) return {};
  return fmt::format("{}: other processes took {:.0f}% of the machine's CPU time while this case was timed",
                     row.case_name, 100 * share->get<double>());
}

std::uint64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoull(line.substr(6)) * 1024;
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
