#include "harness/measure/provenance.hpp"

#include <fmt/chrono.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "harness/hash.hpp"
#include "harness/measure/interruptions.hpp"
#include "harness/version/version.hpp"

namespace pelage {
namespace {

/// Environment variables of PoCL that change the compiled kernels or the threads that run them. POCL_AFFINITY
/// is not in this list, because rows record it in a separate field.
constexpr std::array kPoclVariables{"POCL_WORK_GROUP_METHOD",   "POCL_EXTRA_BUILD_FLAGS",
                                    "POCL_MAX_WORK_GROUP_SIZE", "POCL_CPU_MAX_CU_COUNT",
                                    "POCL_MAX_PTHREAD_COUNT",   "POCL_MAX_COMPUTE_UNITS"};

std::string first_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

/// Returns the values of a field of /proc/cpuinfo, one for each CPU.
std::vector<std::string> cpu_values(std::string_view field) {
  std::ifstream stream("/proc/cpuinfo");
  std::vector<std::string> values;
  for (std::string line; std::getline(stream, line);)
    if (const std::size_t colon = line.find(": "); line.starts_with(field) && colon != std::string::npos)
      values.push_back(line.substr(colon + 2));
  return values;
}

std::string os_name() {
  std::ifstream stream("/etc/os-release");
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("PRETTY_NAME=\"")) return line.substr(13, line.size() - 14);
  return {};
}

}  // namespace

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

std::string utc_stamp() {
  return fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(std::time(nullptr)));
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : -1;
}

double unix_time() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

double cpu_mhz() {
  const std::vector<std::string> cpus = cpu_values("cpu MHz");
  double sum = 0;
  for (const std::string& mhz : cpus) sum += std::strtod(mhz.c_str(), nullptr);
  return cpus.empty() ? -1 : sum / double(cpus.size());
}

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size()) != 0) return "unknown";
  const std::string text = name.data();
  return text.substr(0, text.find('.'));
}

std::string file_name_of(const std::string& text) {
  std::string result = text;
  for (char& c : result)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '-') c = '_';
  return result.empty() || result.front() == '.' ? "_" + result : result;
}

nlohmann::ordered_json host_provenance(const std::vector<std::string>& argv, bool anonymous) {
  nlohmann::ordered_json json;
  const BuildInfo& build = build_info();
  json["version"] = build.version;
  json["revision"] = build.revision;
  json["dirty"] = build.dirty;
  json["compiler"] = build.compiler;
  json["flags"] = build.flags;
  json["host"] = anonymous ? "anonymous" : host_name();
  std::vector<std::string> words = argv;
  if (anonymous)
    for (std::string& word : words)
      if (word.find('/') != std::string::npos && word.find('=') == std::string::npos)
        word = std::filesystem::path(word).filename().string();
  json["argv"] = words;
  utsname system{};
  if (uname(&system) == 0) json["os_kernel"] = std::string(system.sysname) + " " + system.release;
  json["os"] = os_name();
  const std::vector<std::string> cpus = cpu_values("model name");
  json["cpu"] = cpus.empty() ? "" : cpus.front();
  json["cpus"] = sysconf(_SC_NPROCESSORS_ONLN);
  json["governor"] = first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  return json;
}

nlohmann::ordered_json device_provenance(const cl::DeviceInfo& info) {
  nlohmann::ordered_json json;
  json["platform"] = info.platform;
  json["platform_version"] = info.platform_version;
  json["device_name"] = info.name;
  json["device_version"] = info.version;
  json["driver"] = info.driver;
  json["compute_units"] = info.compute_units;
  json["lanes"] = info.lanes;
  if (const char* pinned = std::getenv("POCL_AFFINITY"); pinned && info.cpu) json["pocl_affinity"] = pinned;
  nlohmann::ordered_json environment;
  for (const char* name : kPoclVariables)
    if (const char* value = std::getenv(name); value && info.cpu) environment[name] = value;
  if (!environment.empty()) json["environment"] = environment;
  if (info.cpu) {  // only where the process has less than the whole machine, because the rows' identity has
                   // them
    if (const int cores = usable_cores(); cores < sysconf(_SC_NPROCESSORS_ONLN)) json["usable_cores"] = cores;
    if (const auto quota = cpu_quota()) json["cpu_quota"] = *quota;
  }
  json["timer"] = info.timer_resolution_ns > 0 ? "OpenCL events and the wall clock" : "the wall clock";
  json["timer_resolution_ns"] = info.timer_resolution_ns;
  return json;
}

void add_programs(Identity& identity, const std::vector<const cl::Program*>& programs) {
  for (const cl::Program* program : programs)
    identity[kernel_part + program->file()] = cl::hash_of(program->sources());
}

std::string build_hash() {
  const BuildInfo& build = build_info();
  return Hash().text(build.compiler).text(build.flags).hex();
}

}  // namespace pelage
