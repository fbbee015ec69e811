// Provenance of a row of results: the program, the machine, the device and the time of the measurement.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/cl/device.hpp"
#include "harness/cl/program.hpp"
#include "harness/record/identity.hpp"

namespace pelage {

std::string utc_stamp();  ///< current time in UTC, such as "20261121T001502Z", usable in a file name
std::string utc_now();    ///< current time in UTC, such as "2026-11-21T00:15:02Z"
double load_average();    ///< number of runnable processes, averaged over the last minute; -1 if unknown
double unix_time();       ///< current time in seconds since 1970, including fractions of a second
double cpu_mhz();  ///< mean of the current frequencies of all CPUs in MHz, from /proc/cpuinfo; -1 if unknown
std::string host_name();  ///< host name up to the first dot

/// Returns `text` as a part of a file name: '_' for all characters except letters, digits, '.', '_' and '-'.
std::string file_name_of(const std::string& text);

/// Returns the provenance of the program and the host. If `anonymous` is true, the host's name is replaced by
/// "anonymous", and paths in argv are reduced to file names, except in arguments that contain "=".
nlohmann::ordered_json host_provenance(const std::vector<std::string>& argv, bool anonymous);

/// Returns the provenance of the device: its platform, driver, name and timer.
nlohmann::ordered_json device_provenance(const cl::DeviceInfo& info);

/// Adds one part per program: the hash of its source files when it was built.
void add_programs(Identity& identity, const std::vector<const cl::Program*>& programs);

/// Returns the hash of the compiler and the flags of pelage, which influence the host's time per frame and
/// the times of the C++ baselines.
std::string build_hash();

}  // namespace pelage
